// Normals tilted by a height map. Needs common/surface.glsl.

// The unit normal of the side that is seen, where heights above the front grow by dU and dV along u and v, measured in
// the unit of the steps along the surface: TBN (-dU, -dV, 1).
vec3 seen_tilted_normal(float dU, float dV) {
    vec3 n = normalize(world_normal);
    n = swap_sides ? -n : n;
    vec3 t = world_tangent - dot(world_tangent, n) * n;
    if (dot(t, t) < 1e-12)   // a point without neighbours: any direction will do
        t = cross(n, abs(n.x) < 0.9 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
    t = normalize(t);
    vec3 b = cross(n, t);   // along growing v
    vec3 tilted = normalize(mat3(t, b, n) * vec3(-dU, -dV, 1.0));
    return seen_front() ? tilted : -tilted;
}
