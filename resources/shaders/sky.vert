// One triangle over the whole picture.
uniform mat4 worldFromClip;
out vec3 direction;

void main() {
    vec2 at = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    vec4 far = worldFromClip * vec4(at, 1.0, 1.0);
    vec4 near = worldFromClip * vec4(at, -1.0, 1.0);
    direction = orthographic() ? normalize(forward.xyz) + up.xyz * at.y * 0.35 : far.xyz / far.w - near.xyz / near.w;
    gl_Position = vec4(at, 1.0, 1.0);
}
