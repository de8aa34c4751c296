layout(location = 0) in vec3 corner;
layout(location = 1) in vec3 cornerNormal;
layout(location = 2) in vec3 wallTint;
layout(location = 3) in vec2 along; // [m] in the plane
out vec3 point;
out vec2 grid;
flat out vec3 normal;
flat out vec3 tintHere;

void main() {
    point = corner;
    normal = cornerNormal;
    tintHere = wallTint;
    grid = along;
    gl_Position = clipFromWorld * vec4(corner, 1.0);
}
