// Cylinders and cuboids: a mesh in -1..1 stretched to the body's half sizes.
layout(location = 0) in vec3 corner;
layout(location = 1) in vec3 cornerNormal;
out vec3 point;
out vec3 normal;
out vec3 inMesh;
flat out vec4 meshTint; // w: pattern

void main() {
    vec3 grown = halfSize.xyz + growth * pixelAt(place.xyz);
    inMesh = corner;
    point = place.xyz + turned(orientation, corner * grown);
    normal = turned(orientation, normalize(cornerNormal / halfSize.xyz));
    meshTint = vec4(tint.rgb, place.w);
    gl_Position = clipFromWorld * vec4(point, 1.0);
}
