layout(location = 0) in vec3 corner;
layout(location = 1) in vec3 tint;
flat out vec3 lineTint;

void main() {
    lineTint = tint;
    gl_Position = clipFromWorld * vec4(corner, 1.0);
}
