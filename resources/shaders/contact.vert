// A square on a floor around the foot of each sphere near it.
layout(location = 0) in vec3 corner;
uniform vec4 floorPlane; // normal, offset
flat out vec4 ball;
out vec3 onFloor;

void main() {
    vec3 centre = place().xyz;
    float radius = halfSize().x;
    float height = dot(floorPlane.xyz, centre) - floorPlane.w;
    ball = vec4(centre, radius);
    if (height < 0.0 || height > 3.0 * radius) {
        onFloor = vec3(0.0);
        gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
        return;
    }
    vec3 n = floorPlane.xyz;
    vec3 x = normalize(abs(n.x) < 0.9 ? cross(n, vec3(1.0, 0.0, 0.0)) : cross(n, vec3(0.0, 1.0, 0.0)));
    onFloor = centre - height * n + 2.6 * radius * (corner.x * x + corner.y * cross(n, x));
    gl_Position = clipFromWorld * vec4(onFloor, 1.0);
}
