in vec3 direction;
out vec4 colour;

void main() {
    float height = direction.y * inversesqrt(dot(direction, direction));
    vec3 sky = height >= 0.0 ? mix(skyHorizon.rgb, skyTop.rgb, smoothstep(0.0, 0.7, height))
                             : mix(skyHorizon.rgb, ground.rgb, smoothstep(0.0, 0.35, -height));
    // Less than one step of the display, in a scattered order: no bands.
    float grain = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
    colour = vec4(sky + grain / 255.0, 1.0);
}
