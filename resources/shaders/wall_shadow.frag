// Multiplies what the wall's pass has drawn; the light it takes away was the same everywhere.
in vec3 onWall;
in vec3 inMap;
flat in vec3 darkest;
out vec4 colour;

void main() {
    vec2 texel = 1.0 / vec2(textureSize(shadowMap, 0));
    float depth = min(inMap.z, 1.0);
    float arrives = 0.0;
    arrives += texture(shadowMap, vec3(inMap.xy + texel * vec2(-0.7, -1.9), depth));
    arrives += texture(shadowMap, vec3(inMap.xy + texel * vec2(1.9, -0.7), depth));
    arrives += texture(shadowMap, vec3(inMap.xy + texel * vec2(0.7, 1.9), depth));
    arrives += texture(shadowMap, vec3(inMap.xy + texel * vec2(-1.9, 0.7), depth));
    float fade = 1.0 - smoothstep(0.3, 1.0, length(onWall));
    colour = vec4(mix(vec3(1.0), darkest, (1.0 - 0.25 * arrives) * fade), 1.0);
}
