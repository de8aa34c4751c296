// Two directional lights, a sky, and the shadow of the first light.
uniform sampler2DShadow shadowMap;

// What reaches a surface besides the first light.
vec3 softLight(vec3 normal) {
    vec3 sky = 0.5 * (linear(skyTop.rgb) + linear(skyHorizon.rgb));
    vec3 ambient = mix(linear(ground.rgb), sky, 0.5 + 0.5 * normal.y) * keyColour.w + 0.05;
    return ambient + max(dot(normal, fillDirection.xyz), 0.0) * fillColour.rgb;
}

vec3 skyLight(vec3 direction) {
    vec3 above = mix(linear(skyHorizon.rgb), linear(skyTop.rgb), max(direction.y, 0.0));
    return mix(above, linear(ground.rgb), clamp(-3.0 * direction.y, 0.0, 1.0));
}

// gloss 0 is chalk, 1 a polished ball. One look at the shadow map, whose own filter blends four texels.
vec3 shaded(vec3 albedo, vec3 point, vec3 normal, vec3 toEye, float gloss) {
    vec3 lifted = point + (1.5 * normal + keyDirection.xyz) * keyDirection.w;
    vec3 at = (shadowFromWorld * vec4(lifted, 1.0)).xyz;
    float inMap = step(max(abs(at.x - 0.5), abs(at.y - 0.5)), 0.5);
    float arrives = mix(1.0, texture(shadowMap, vec3(at.xy, min(at.z, 1.0))), up.w * inMap);
    // The light wraps a little around the edge of night, as that of a lamp of some size does.
    float lamp = clamp((dot(normal, keyDirection.xyz) + 0.2) / 1.2, 0.0, 1.0);
    float key = lamp * sqrt(lamp) * arrives;
    vec3 light = albedo * (softLight(normal) + key * keyColour.rgb);

    vec3 mirrored = reflect(-toEye, normal);
    float shine = max(dot(mirrored, keyDirection.xyz), 0.0);
    shine *= shine;
    shine *= shine;                     // 4
    float sharp = shine * shine * shine;
    sharp *= sharp;                     // 24
    sharp *= sharp;                     // 48
    float rim = 1.0 - max(dot(normal, toEye), 0.0);
    rim *= rim;
    rim *= rim;
    light += gloss * ((0.09 * shine * key + 0.9 * sharp * arrives) * keyColour.rgb + (0.03 + 0.32 * rim) * skyLight(mirrored));
    return displayed(light);
}
