// A wall with a fine grid that fades into the distance. From behind it is a breath of colour and its grid.
in vec3 point;
in vec2 grid;
flat in vec3 normal;
flat in vec3 tintHere;
uniform float opacity;
out vec4 colour;

// 1 on a line of the grid, anti-aliased; nothing where lines would crowd.
float lines(float spacing) {
    vec2 footprint = fwidth(grid);
    vec2 away = abs(fract(grid / spacing - 0.5) - 0.5) * spacing / max(footprint, vec2(1e-9));
    float crowded = max(footprint.x, footprint.y) / spacing;
    return (1.0 - min(min(away.x, away.y), 1.0)) * (1.0 - smoothstep(0.08, 0.35, crowded));
}

void main() {
    float whiteness = min(min(tintHere.r, tintHere.g), tintHere.b);
    vec3 albedo = linear(mix(tintHere, floorTint.rgb, whiteness));
    float line = max(0.5 * lines(picture.z), lines(5.0 * picture.z)) * floorTint.w;
    float away = length(point - roomCentre.xyz) / roomCentre.w;
    float fade = 1.0 - smoothstep(0.25, 1.0, away);
    if (opacity < 1.0) {
        colour = vec4(displayed(albedo), (opacity + 0.9 * line) * fade);
        return;
    }
    albedo *= dot(albedo, vec3(0.33)) > 0.5 ? 1.0 - 0.45 * line : 1.0 + 0.9 * line;
    colour = vec4(shaded(albedo, point, normal, 0.0), fade);
}
