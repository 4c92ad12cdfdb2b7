// The ends of springs, for common/lines_geometry.glsl.
in vec3 position;
in vec3 normal;
in float quantity;   // what the shader's declaration names
out vec3 point;
out vec3 up;
out float end_quantity;

void main() {
    point = position;
    up = normal;
    end_quantity = quantity;
}
