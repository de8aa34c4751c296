in vec2 inDisc;

void main() {
    if (dot(inDisc, inDisc) > 1.0) discard;
}
