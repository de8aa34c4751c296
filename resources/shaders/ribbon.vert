// A line as a band of constant width on the screen: both corners at one end lie beside it.
layout(location = 0) in vec3 corner;
layout(location = 1) in vec3 other; // the other end
layout(location = 2) in vec3 tint;
layout(location = 3) in float side; // -1 or 1, seen from this end
uniform float halfWidth;            // px
flat out vec3 lineTint;

// The part of a line that is behind the eye is cut off.
vec4 before(vec4 point, vec4 next, float nearest) {
    return point.w < nearest && next.w > nearest ? mix(point, next, (nearest - point.w) / (next.w - point.w)) : point;
}

void main() {
    lineTint = tint;
    vec4 here = clipFromWorld * vec4(corner, 1.0), there = clipFromWorld * vec4(other, 1.0);
    float nearest = 1e-4 * max(abs(here.w), abs(there.w));
    vec4 from = before(here, there, nearest), to = before(there, here, nearest);
    vec2 way = (to.xy / to.w - from.xy / from.w) * picture.xy;
    vec2 across = vec2(-way.y, way.x) / max(length(way), 1e-6);
    gl_Position = from + vec4(2.0 * halfWidth * side * across / picture.xy * from.w, 0.0, 0.0);
}
