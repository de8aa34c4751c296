// The silhouette in one colour: outlines and shadow maps.
uniform vec4 flatColour;
out vec4 colour;

void main() {
    Surface surface = surfaceHere();
    if (surface.coverage < 0.5) discard;
    gl_FragDepth = depthOf(surface.point);
    colour = flatColour;
}
