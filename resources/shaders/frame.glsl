// What every pass knows of the camera, the light and the theme. Mirrors FrameUniforms of ui/viewport/lighting.
layout(std140) uniform Frame {
    mat4 clipFromWorld;
    mat4 shadowFromWorld; // to texture coordinates and depth of the shadow map
    vec4 eye;             // w: 1 in an orthographic picture, else 0
    vec4 forward;         // w: world metres a pixel covers, at depth 1 where there is perspective
    vec4 up;              // w: strength of shadows
    vec4 keyDirection;    // towards the light; w: world metres of a texel of the shadow map
    vec4 keyColour;
    vec4 fillDirection;
    vec4 fillColour;      // w: how much walls darken away from the scene
    vec4 skyTop;
    vec4 skyHorizon;
    vec4 ground;
    vec4 floorTint;   // what a white wall looks like; w: strength of the grid
    vec4 roomCentre;  // w: radius at which walls have faded
    vec4 picture;     // width, height [px], grid spacing [m], dimming 0..1
    vec4 lightAbove;  // what reaches a surface that looks up besides the two lights, linear
    vec4 lightBelow;
    vec4 mirrorTop;   // the sky's and the ground's colours, linear
    vec4 mirrorHorizon;
    vec4 mirrorGround;
};

bool orthographic() { return eye.w > 0.5; }

// Metres that a pixel covers at a point.
float pixelAt(vec3 point) { return orthographic() ? forward.w : forward.w * max(dot(point - eye.xyz, forward.xyz), 0.0); }

// Colours are kept as displayed, light is added in a linear space: gamma 2 is close enough and costs nothing.
vec3 linear(vec3 displayed) { return displayed * displayed; }

vec3 displayed(vec3 light) {
    vec3 colour = sqrt(min(light, 1.0));
#ifdef DIMMED
    float grey = dot(colour, vec3(0.3, 0.59, 0.11));
    colour = mix(colour, mix(vec3(grey), skyHorizon.rgb, 0.35), picture.w);
#endif
    return colour;
}
