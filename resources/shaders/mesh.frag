in vec3 point;
in vec3 normal;
in vec3 inMesh;
flat in vec4 meshTint;
out vec4 colour;

void main() {
    vec3 albedo = linear(meshTint.rgb);
    // Opposite quarters about the axis in two tones, so that a turn can be seen.
    if (meshTint.w > 0.0) albedo *= 1.0 - 0.28 * meshTint.w * step(0.0, inMesh.x * inMesh.z);
    vec3 toEye = orthographic() ? -forward.xyz : normalize(eye.xyz - point);
    colour = vec4(shaded(albedo, point, normalize(normal), toEye, 0.35), 1.0);
}
