// One body, as ui/viewport/instances writes it.
layout(location = 2) in vec4 place;       // position [m]; w: strength of the pattern that shows spin
layout(location = 3) in vec4 orientation; // quaternion x, y, z, w
layout(location = 4) in vec4 halfSize;    // [m]
layout(location = 5) in vec4 tint;        // as displayed
uniform float growth;                     // outlines: bodies are drawn this much larger [px]

vec3 turned(vec4 by, vec3 v) { return v + 2.0 * cross(by.xyz, cross(by.xyz, v) + by.w * v); }
