// A wall with a fine grid that fades into the distance. From behind it is a breath of colour and its grid.
in vec2 grid;
in vec3 fromCentre;
flat in vec3 base;
flat in vec3 onLines;
flat in float darkening;
uniform float opacity;
out vec4 colour;

// 1 on a line of a grid of unit spacing, anti-aliased; nothing where lines would crowd.
float lines(vec2 at, vec2 footprint) {
    vec2 away = abs(fract(at - 0.5) - 0.5) / footprint;
    float crowded = max(footprint.x, footprint.y);
    return (1.0 - min(min(away.x, away.y), 1.0)) * (1.0 - smoothstep(0.08, 0.35, crowded));
}

void main() {
    vec2 cells = grid / picture.z;
    vec2 footprint = max(fwidth(cells), vec2(1e-7));
    float line = max(0.5 * lines(cells, footprint), lines(0.2 * cells, 0.2 * footprint));
    float away = length(fromCentre);
    float fade = 1.0 - smoothstep(0.3, 1.0, away);
    float lamp = 1.0 - darkening * smoothstep(0.0, 0.6, away);
    if (opacity < 1.0)
        colour = vec4(base, (opacity + 0.25 * line) * fade);
    else
        colour = vec4(mix(base, onLines, line) * lamp, fade);
}
