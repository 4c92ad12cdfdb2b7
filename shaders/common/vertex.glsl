// What a vertex stage is given, and gives to common/cloth.glsl. Needs common/frame.glsl.
in vec3 position;     // m; of a sphere on the unit sphere
in vec3 normal;       // of length 1
in vec3 tangent;      // along growing u: change of position
in vec2 uv;           // 0 to 1 along columns and rows
in float quantity;    // what the shader's declaration names: strain, speed ...
out vec3 world_position;
out vec3 world_normal;
out vec3 world_tangent;
out vec2 surface_uv;
out float surface_quantity;

uniform vec4 object;   // xyz: m, where the mesh's origin is; w: its size, 1 for the cloth
uniform float depth;   // as a share of the distance; above 1 for spheres: cloth that lies on them must hide them
uniform bool swap_sides;   // the front is the side that the normals do not point to

vec3 placed(vec3 point) { return object.xyz + object.w * point; }

// Where the point is in a picture that the front shows upright: rows grow downwards, except where sides are swapped.
vec2 picture_uv() { return vec2(uv.x, swap_sides ? uv.y : 1.0 - uv.y); }

vec3 front_normal() { return swap_sides ? -normal : normal; }

// Sets everything for a point at a place.
void place(vec3 at, vec3 up) {
    world_position = at;
    world_normal = up;
    world_tangent = object.w * tangent;
    surface_uv = picture_uv();
    surface_quantity = quantity;
    gl_Position = to_clip(at, depth);
}
