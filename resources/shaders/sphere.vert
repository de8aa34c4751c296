// A quad through the sphere's centre, square to the line of sight, just large enough for its silhouette:
// from distance d the cone that touches a sphere of radius r has radius r d / sqrt(d² - r²) at its centre.
layout(location = 0) in vec3 corner;
flat out vec4 ball;     // centre, radius
flat out vec4 sight;    // unit vector from the eye to the centre; w: radius by distance, 0 without perspective
flat out vec4 ballTurn;
flat out vec4 ballTint; // w: pattern
flat out float pixel;   // by the radius
out vec3 offset;        // from the centre, by the radius

void main() {
    vec4 at = place();
    float covers = pixelAt(at.xyz);
    ball = vec4(at.xyz, halfSize().x + growth * covers);
    ballTurn = orientation();
    ballTint = vec4(tint().rgb, at.w);
    pixel = covers / ball.w;
    sight = vec4(forward.xyz, 0.0);
    float reach = 1.0;
    if (!orthographic()) {
        vec3 toCentre = at.xyz - eye.xyz;
        float square = dot(toCentre, toCentre);
        float beyond = square - ball.w * ball.w;
        if (beyond <= 1e-6 * square) { // the eye is inside: nothing of the surface to see
            offset = vec3(0.0);
            gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
            return;
        }
        float inverse = inversesqrt(square);
        sight = vec4(toCentre * inverse, ball.w * inverse);
        reach = sqrt(square / beyond);
    }
    vec3 x = normalize(cross(sight.xyz, up.xyz));
    vec3 y = cross(x, sight.xyz);
    offset = (reach + pixel) * (corner.x * x + corner.y * y);
    gl_Position = clipFromWorld * vec4(at.xyz + ball.w * offset, 1.0);
}
