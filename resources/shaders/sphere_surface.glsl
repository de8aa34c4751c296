// Where the ray of this fragment meets its sphere.
//
// With lengths in radii, k = radius / distance of the eye, s the sight and o the ray's point on the quad
// (o ⟂ s, q = o·o), the ray is e + t (o - e) with e = -s / k. It meets |x| = 1 where
//
//     t = (1 - k root) / (1 + q k²)     root = sqrt(1 + q k² - q)
//     x = t o - s (q k + root) / (1 + q k²)
//
// which holds without perspective, too (k = 0). Its nearest point to the centre is sqrt(q / (1 + q k²)) away.
flat in vec4 ball;
flat in vec4 sight;
flat in vec4 ballTurn;
flat in vec4 ballTint;
flat in float pixel;
in vec3 offset;

struct Surface {
    vec3 point, normal, toEye;
    float coverage; // of the pixel by the silhouette, 0..1
};

Surface surfaceHere() {
    float q = dot(offset, offset);
    float k = sight.w;
    float whole = 1.0 + q * k * k;
    float inverse = 1.0 / whole;
    float gap = q * inverse; // squared
    Surface surface;
    surface.coverage = clamp((1.0 - gap) / (2.0 * pixel) + 0.5, 0.0, 1.0);
    float root = sqrt(max(whole - q, 0.0));
    surface.normal = (offset * (1.0 - k * root) - sight.xyz * (q * k + root)) * inverse;
    // Rays that pass the sphere within half a pixel: their nearest point, drawn in to the surface.
    surface.normal *= 1.5 - 0.5 * min(max(gap, 1.0), 2.0);
    surface.toEye = -(sight.xyz + k * offset) * sqrt(inverse);
    surface.point = ball.xyz + ball.w * surface.normal;
    return surface;
}

float depthOf(vec3 point) {
    vec4 clip = clipFromWorld * vec4(point, 1.0);
    return 0.5 * clip.z / clip.w + 0.5;
}
