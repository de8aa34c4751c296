// Where the ray of this fragment meets its sphere.
flat in vec4 ball;
flat in vec4 ballTurn;
flat in vec4 ballTint;
flat in float pixel;
in vec3 onQuad;

struct Surface {
    vec3 point, normal, toEye;
    float coverage; // of the pixel by the silhouette, 0..1
};

Surface surfaceHere() {
    vec3 origin = orthographic() ? onQuad - 2.0 * ball.w * forward.xyz : eye.xyz;
    vec3 direction = orthographic() ? forward.xyz : normalize(onQuad - eye.xyz);
    vec3 toCentre = ball.xyz - origin;
    float nearest = dot(toCentre, direction);
    vec3 across = nearest * direction - toCentre; // from the centre to the ray's nearest point
    float gap = length(across);
    Surface surface;
    surface.toEye = -direction;
    surface.coverage = clamp((ball.w - gap) / pixel + 0.5, 0.0, 1.0);
    float half_chord = sqrt(max(ball.w * ball.w - gap * gap, 0.0));
    surface.normal = normalize(across - half_chord * direction);
    surface.point = ball.xyz + ball.w * surface.normal;
    return surface;
}

float depthOf(vec3 point) {
    vec4 clip = clipFromWorld * vec4(point, 1.0);
    return 0.5 * clip.z / clip.w + 0.5;
}
