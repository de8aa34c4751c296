// A quad through the sphere's centre, square to the line of sight, just large enough for its silhouette:
// from distance d the cone that touches a sphere of radius r has radius r d / sqrt(d² - r²) at its centre.
layout(location = 0) in vec3 corner;
flat out vec4 ball; // centre, radius
flat out vec4 ballTurn;
flat out vec4 ballTint; // w: pattern
flat out float pixel;
out vec3 onQuad;

void main() {
    pixel = pixelAt(place.xyz);
    ball = vec4(place.xyz, halfSize.x + growth * pixel);
    ballTurn = orientation;
    ballTint = vec4(tint.rgb, place.w);
    vec3 sight = forward.xyz;
    float reach = ball.w;
    if (!orthographic()) {
        vec3 toCentre = ball.xyz - eye.xyz;
        float square = dot(toCentre, toCentre);
        float beyond = square - ball.w * ball.w;
        if (beyond <= 1e-6 * square) { // the eye is inside: nothing of the surface to see
            onQuad = vec3(0.0);
            gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
            return;
        }
        sight = toCentre * inversesqrt(square);
        reach = ball.w * sqrt(square / beyond);
    }
    vec3 x = normalize(cross(sight, up.xyz));
    vec3 y = cross(x, sight);
    onQuad = ball.xyz + (reach + pixel) * (corner.x * x + corner.y * y);
    gl_Position = clipFromWorld * vec4(onQuad, 1.0);
}
