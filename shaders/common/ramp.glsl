// The colour at x of a ramp: 0 is the middle of its first pixel, 1 that of its last; beyond them the ends.
vec3 ramp_colour(sampler2D ramp, float x) {
    float n = float(textureSize(ramp, 0).x);
    return texture(ramp, vec2((clamp(x, 0.0, 1.0) * (n - 1.0) + 0.5) / n, 0.5)).rgb;
}

// A value's colour in a map whose ends stand for `low` and `high`, in either order.
vec3 map_colour(sampler2D map, float value, float low, float high) {
    float range = high - low;
    return ramp_colour(map, abs(range) > 1e-9 ? (value - low) / range : step(low, value));
}
