flat in vec3 lineTint;
uniform float opacity;
out vec4 colour;

void main() { colour = vec4(lineTint, opacity); }
