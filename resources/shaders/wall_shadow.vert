// The part of a wall that lies under the shadow map.
layout(location = 0) in vec3 corner;
uniform vec4 wallNormal;
out vec3 onWall;
out vec3 inMap;
flat out vec3 darkest; // what is left of the colour where no first light arrives

void main() {
    vec3 soft = softLight(wallNormal.xyz);
    vec3 key = max(dot(wallNormal.xyz, keyDirection.xyz), 0.0) * keyColour.rgb;
    darkest = sqrt((soft + (1.0 - up.w) * key) / (soft + key));
    onWall = (corner - roomCentre.xyz) / roomCentre.w;
    inMap = (shadowFromWorld * vec4(corner + keyDirection.xyz * 2.0 * keyDirection.w, 1.0)).xyz;
    gl_Position = clipFromWorld * vec4(corner, 1.0);
}
