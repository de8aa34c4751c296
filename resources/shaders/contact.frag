// How much of the sky a sphere hides from a floor: cos(angle) r² / d² of the hemisphere, weighted by cosine.
flat in vec4 ball;
in vec3 onFloor;
uniform vec4 floorPlane;
out vec4 colour;

void main() {
    vec3 toBall = ball.xyz - onFloor;
    float square = dot(toBall, toBall);
    float hidden = dot(toBall, floorPlane.xyz) * inversesqrt(square) * ball.w * ball.w / square;
    float edge = 2.6 * ball.w;
    vec3 foot = ball.xyz - dot(toBall, floorPlane.xyz) * floorPlane.xyz;
    float fade = 1.0 - smoothstep(0.4, 1.0, length(onFloor - foot) / edge);
    colour = vec4(0.0, 0.0, 0.0, 0.62 * clamp(hidden, 0.0, 1.0) * fade * up.w);
}
