// The body that a vertex belongs to, as ui/viewport/instances writes it: four texels each.
layout(location = 2) in int copy; // which one, counted from the first of the draw call
uniform samplerBuffer instances;
uniform int firstInstance;
uniform float growth; // outlines: bodies are drawn this much larger [px]

vec4 part(int i) { return texelFetch(instances, 4 * (firstInstance + copy) + i); }
vec4 place() { return part(0); }       // position [m]; w: strength of the pattern that shows spin
vec4 orientation() { return part(1); } // quaternion x, y, z, w
vec4 halfSize() { return part(2); }    // [m]
vec4 tint() { return part(3); }        // as displayed

vec3 turned(vec4 by, vec3 v) { return v + 2.0 * cross(by.xyz, cross(by.xyz, v) + by.w * v); }
