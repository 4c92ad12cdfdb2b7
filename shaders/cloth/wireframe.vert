#version 330 core
in vec3 position;
in vec3 normal;
out vec3 point;
out vec3 up;

void main() {
    point = position;
    up = normal;
}
