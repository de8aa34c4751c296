// Two directional lights, a sky, and the shadow of the first light.
uniform sampler2DShadow shadowMap;

// What reaches a surface besides the first light.
vec3 softLight(vec3 normal) {
    vec3 ambient = mix(lightBelow.rgb, lightAbove.rgb, 0.5 + 0.5 * normal.y);
    return ambient + max(dot(normal, fillDirection.xyz), 0.0) * fillColour.rgb;
}

vec3 skyLight(vec3 direction) {
    vec3 above = mix(mirrorHorizon.rgb, mirrorTop.rgb, max(direction.y, 0.0));
    return mix(above, mirrorGround.rgb, clamp(-3.0 * direction.y, 0.0, 1.0));
}

// gloss 0 is chalk, 1 a polished ball. One look at the shadow map, whose own filter blends four texels.
vec3 shaded(vec3 albedo, vec3 point, vec3 normal, vec3 toEye, float gloss) {
    float arrives = 1.0;
#ifdef SHADOWS
    vec3 lifted = point + (1.5 * normal + keyDirection.xyz) * keyDirection.w;
    vec3 at = (shadowFromWorld * vec4(lifted, 1.0)).xyz;
    float inMap = step(max(abs(at.x - 0.5), abs(at.y - 0.5)), 0.5);
    arrives = mix(1.0, texture(shadowMap, vec3(at.xy, min(at.z, 1.0))), up.w * inMap);
#endif
    // The light wraps a little around the edge of night, as that of a lamp of some size does.
    float lamp = clamp((dot(normal, keyDirection.xyz) + 0.2) / 1.2, 0.0, 1.0);
    float key = lamp * sqrt(lamp) * arrives;
    vec3 light = albedo * (softLight(normal) + key * keyColour.rgb);

    float facing = dot(normal, toEye);
    vec3 mirrored = 2.0 * facing * normal - toEye;
    float shine = max(dot(mirrored, keyDirection.xyz), 0.0);
    shine *= shine;
    shine *= shine;                     // 4
    float sharp = shine * shine * shine;
    sharp *= sharp;                     // 24
    sharp *= sharp;                     // 48
    float rim = 1.0 - max(facing, 0.0);
    rim *= rim;
    rim *= rim;
    light += gloss * ((0.09 * shine * key + 0.9 * sharp * arrives) * keyColour.rgb + (0.03 + 0.32 * rim) * skyLight(mirrored));
    return displayed(light);
}
