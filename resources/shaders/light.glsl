// Two directional lights, a sky, and the shadow of the first light.
uniform sampler2DShadow shadowMap;

// The share of the first light that arrives, 0..1.
float keyArrives(vec3 point, vec3 normal) {
    float texel = keyDirection.w;
    vec3 lifted = point + normal * texel * 1.5 + keyDirection.xyz * texel;
    vec3 at = (shadowFromWorld * vec4(lifted, 1.0)).xyz;
    if (any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(1.0)))) return 1.0;
    vec2 size = vec2(textureSize(shadowMap, 0));
    vec2 step = 0.9 / size;
    float arrives = texture(shadowMap, vec3(at.xy + step * vec2(-0.4, -1.0), at.z)) +
                    texture(shadowMap, vec3(at.xy + step * vec2(1.0, -0.4), at.z)) +
                    texture(shadowMap, vec3(at.xy + step * vec2(0.4, 1.0), at.z)) +
                    texture(shadowMap, vec3(at.xy + step * vec2(-1.0, 0.4), at.z));
    return mix(1.0, arrives * 0.25, up.w);
}

vec3 skyLight(vec3 direction) {
    return direction.y >= 0.0 ? mix(linear(skyHorizon.rgb), linear(skyTop.rgb), direction.y)
                              : mix(linear(skyHorizon.rgb), linear(ground.rgb), min(-3.0 * direction.y, 1.0));
}

// gloss 0 is chalk, 1 a polished ball.
vec3 shaded(vec3 albedo, vec3 point, vec3 normal, float gloss) {
    vec3 toEye = orthographic() ? -forward.xyz : normalize(eye.xyz - point);
    float facing = dot(normal, keyDirection.xyz);
    float key = facing > 0.0 ? facing * keyArrives(point, normal) : 0.0;
    float fill = max(dot(normal, fillDirection.xyz), 0.0);
    vec3 ambient = mix(linear(ground.rgb), linear(skyTop.rgb), 0.5 + 0.5 * normal.y) * 0.55 + 0.06;
    vec3 light = albedo * (ambient + key * keyColour.rgb + fill * fillColour.rgb);
    if (gloss > 0.0) {
        vec3 halfway = normalize(keyDirection.xyz + toEye);
        float shine = max(dot(normal, halfway), 0.0);
        shine *= shine; shine *= shine; shine *= shine; shine *= shine; // 16
        float sharp = shine * shine * shine * shine * shine * shine;    // 96
        float rim = 1.0 - max(dot(normal, toEye), 0.0);
        rim *= rim;
        rim *= rim;
        light += gloss * (key * (0.10 * shine + 0.85 * sharp) * keyColour.rgb +
                          (0.03 + 0.32 * rim) * skyLight(reflect(-toEye, normal)));
    }
    return displayed(light);
}
