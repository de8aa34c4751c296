// Cylinders and cuboids: a mesh in -1..1 stretched to the body's half sizes.
layout(location = 0) in vec3 corner;
layout(location = 1) in vec3 cornerNormal;
out vec3 point;
out vec3 normal;
out vec3 inMesh;
flat out vec4 meshTint; // w: pattern

void main() {
    vec4 at = place();
    vec4 turn = orientation();
    vec3 extent = halfSize().xyz;
    inMesh = corner;
    point = at.xyz + turned(turn, corner * (extent + growth * pixelAt(at.xyz)));
    normal = turned(turn, normalize(cornerNormal / extent));
    meshTint = vec4(tint().rgb, at.w);
    gl_Position = clipFromWorld * vec4(point, 1.0);
}
