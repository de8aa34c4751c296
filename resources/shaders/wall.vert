// A wall is flat and its lights are directional: all of its light is known at its corners.
layout(location = 0) in vec3 corner;
layout(location = 1) in vec3 cornerNormal;
layout(location = 2) in vec3 wallTint;
layout(location = 3) in vec2 along; // [m] in the plane
out vec2 grid;
out vec3 fromCentre; // in units of the radius where walls have faded
flat out vec3 base;
flat out vec3 onLines;
flat out float darkening;

// Cloth rather than paint: a little of the theme's floor in every colour, and white becomes the floor itself.
vec3 cloth(vec3 tint) {
    float whiteness = min(min(tint.r, tint.g), tint.b);
    return mix(tint * vec3(0.78, 0.80, 0.78), mix(vec3(0.38), floorTint.rgb, whiteness), max(whiteness, 0.24));
}

void main() {
    grid = along;
    darkening = fillColour.w;
    fromCentre = (corner - roomCentre.xyz) / roomCentre.w;
    vec3 albedo = linear(cloth(wallTint));
    vec3 light = softLight(cornerNormal) + max(dot(cornerNormal, keyDirection.xyz), 0.0) * keyColour.rgb;
    base = displayed(albedo * light);
    onLines = base * (dot(albedo, vec3(0.33)) > 0.4 ? 1.0 - floorTint.w : 1.0 + floorTint.w);
    gl_Position = clipFromWorld * vec4(corner, 1.0);
}
