// For the shadow map a sphere is a disc a little behind its centre, square to the light. Its shadow is the
// same as the ball's, and its own lit half lies in front of it: a ball never shadows itself by rounding.
layout(location = 0) in vec3 corner;
out vec2 inDisc;

void main() {
    inDisc = corner.xy;
    vec3 across = cross(forward.xyz, up.xyz);
    vec3 onDisc = place().xyz + halfSize().x * (corner.x * across + corner.y * up.xyz + 0.5 * forward.xyz);
    gl_Position = clipFromWorld * vec4(onDisc, 1.0);
}
