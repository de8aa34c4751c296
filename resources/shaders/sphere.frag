out vec4 colour;

void main() {
    Surface surface = surfaceHere();
    if (surface.coverage <= 0.0) discard;
    gl_FragDepth = depthOf(surface.point);
    vec3 albedo = linear(ballTint.rgb);
#ifdef PATTERN
    if (ballTint.w > 0.0) {
        // A broad band about the ball's own equator and a cap at its poles, so that any turn can be seen.
        vec3 inBody = surface.normal + 2.0 * cross(-ballTurn.xyz, cross(-ballTurn.xyz, surface.normal) + ballTurn.w * surface.normal);
        float soft = pixel;
        float band = 1.0 - smoothstep(0.34 - soft, 0.34 + soft, abs(inBody.y));
        float spot = smoothstep(0.90 - soft, 0.90 + soft, abs(inBody.x));
        vec3 second = mix(albedo, dot(albedo, vec3(0.33)) > 0.45 ? albedo * 0.35 : vec3(1.0), 0.7);
        albedo = mix(albedo, second, ballTint.w * clamp(band - spot, 0.0, 1.0));
    }
#endif
    colour = vec4(shaded(albedo, surface.point, surface.normal, surface.toEye, 1.0), surface.coverage);
}
