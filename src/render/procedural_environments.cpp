#include "render/procedural_environments.h"

#include <array>

#include "render/options.h"
#include "render/procedural_colour.h"
#include "render/procedural_noise.h"

namespace clothlab::render {

namespace {

constexpr int size = 256; ///< px

using glm::mix;
using glm::vec3;

/// sRGB of a linear value, from a table: there are half a million pixels.
float encoded(float linear) {
    constexpr int steps = 4096;
    static const std::array<float, steps + 1> table = [] {
        std::array<float, steps + 1> t{};
        for (int i = 0; i <= steps; ++i)
            t[static_cast<std::size_t>(i)] = srgb_from_linear(static_cast<float>(i) / steps);
        return t;
    }();
    return table[static_cast<std::size_t>(std::lround(std::clamp(linear, 0.f, 1.f) * steps))];
}

/// A cube map from a function of the direction, of length 1, that returns linear values; each pixel is the mean of
/// samples x samples.
template <class Function>
Cube<Image> surround(int samples, Function light_from) {
    Cube<Image> cube;
    const float step = 2 / static_cast<float>(size * samples), weight = 1 / static_cast<float>(samples * samples);
    for (int face = 0; face < 6; ++face) {
        Image& image = cube[static_cast<std::size_t>(face)];
        image = {size, size, {}};
        image.rgba.reserve(std::size_t{4} * size * size);
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                vec3 sum(0);
                for (int i = 0; i < samples * samples; ++i) {
                    const float s = (static_cast<float>(x * samples + i % samples) + 0.5f) * step - 1;
                    const float t = (static_cast<float>(y * samples + i / samples) + 0.5f) * step - 1;
                    const std::array<float, 3> d = cube_direction(face, s, t);
                    // What is brighter than white is cut off before the mean is taken, or edges would have steps.
                    sum += glm::min(light_from(glm::normalize(vec3(d[0], d[1], d[2]))), vec3(1));
                }
                sum *= weight;
                append(image, {encoded(sum.x), encoded(sum.y), encoded(sum.z)});
            }
        }
    }
    return cube;
}

// --- sky -------------------------------------------------------------------------------------------------------------

vec3 sky_light(const vec3& d) {
    static const vec3 sun = glm::normalize(Options{}.lights[0].position);
    const vec3 haze(0.62f, 0.72f, 0.82f);
    const float towards_sun = std::max(glm::dot(d, sun), 0.f);
    if (d.y < 0) {
        // Ground seen from 1 m above it, fading into the haze.
        const float distance = 1 / std::max(-d.y, 1e-3f);
        const float x = d.x * distance, z = d.z * distance;
        const float patches = fractal_noise(x * 0.8f + 500, z * 0.8f + 500, 0.5f, 4, 51);
        const vec3 earth =
            mix(vec3(0.115f, 0.095f, 0.065f), vec3(0.20f, 0.19f, 0.11f), smooth_step(0.3f, 0.7f, patches));
        return mix(earth, haze * 0.85f, smooth_step(0, 1, std::exp(-7 * -d.y)));
    }
    const float height = std::sqrt(d.y);
    vec3 light =
        mix(haze, mix(vec3(0.20f, 0.42f, 0.80f), vec3(0.055f, 0.16f, 0.46f), height), smooth_step(0, 0.5f, height));
    // A layer of clouds, thinner towards the horizon.
    const float distance = 1 / (d.y + 0.12f);
    const float cover = fractal_noise(d.x * distance * 0.9f + 300, d.z * distance * 0.9f + 300, 0.5f, 5, 52);
    const float cloud = smooth_step(0.5f, 0.74f, cover) * smooth_step(0.02f, 0.3f, d.y);
    const float shaded = smooth_step(0.6f, 0.85f, cover);
    light = mix(light, mix(vec3(0.93f, 0.94f, 0.96f), vec3(0.66f, 0.70f, 0.77f), shaded), 0.9f * cloud);
    // The sun, ten times as wide as the real one so that a wrinkled mirror shows it, and its glow.
    const float squared = towards_sun * towards_sun, glow = squared * squared * squared * squared;
    light += vec3(1.f, 0.93f, 0.78f) * (0.18f * glow + 0.5f * glow * glow * glow * glow);
    return mix(light, vec3(4), smooth_step(0.9955f, 0.9965f, towards_sun));
}

// --- room ------------------------------------------------------------------------------------------------------------

const vec3 room_low(-3.2f, -1.3f, -2.8f), room_high(3.2f, 1.7f, 2.8f); ///< m

/// 1 inside the rectangle, 0 outside.
bool inside(float x, float y, float x0, float x1, float y0, float y1) {
    return x > x0 && x < x1 && y > y0 && y < y1;
}

/// A floor of planks along z, with joints.
vec3 wood(float x, float z) {
    constexpr float plank = 0.22f, length = 1.9f; // m
    const int row = static_cast<int>(std::floor(x / plank + 100));
    const float along = z / length + random_at(row, 0, 61);
    const int piece = static_cast<int>(std::floor(along + 100));
    const float across = x / plank + 100 - static_cast<float>(row), end = along + 100 - static_cast<float>(piece);
    if (across < 0.025f || across > 0.975f || end < 0.004f)
        return vec3(0.045f, 0.022f, 0.010f);
    const float shift = 10 * random_at(row, piece, 62);
    const float grain = fractal_noise(x * 26 + 50 + shift, z * 1.6f + 50 + shift, 0.5f, 3, 63);
    const vec3 base = mix(vec3(0.20f, 0.095f, 0.038f), vec3(0.36f, 0.19f, 0.085f), random_at(row, piece, 64));
    return base * (0.65f + 0.7f * grain);
}

/// What one sees through a window pane: sky above roofs.
vec3 outside_light(float height) {
    return height < -0.1f ? vec3(0.34f, 0.36f, 0.36f)
                          : mix(vec3(0.95f, 0.97f, 1.f), vec3(0.62f, 0.80f, 1.f), smooth_step(-0.1f, 1.2f, height));
}

/// A window from x0 to x1 on a wall, with a frame and bars. False where there is wall.
bool window(float x, float y, float x0, float x1, vec3& light) {
    constexpr float y0 = -0.6f, y1 = 1.35f, frame = 0.06f, bar = 0.02f; // m
    if (!inside(x, y, x0 - frame, x1 + frame, y0 - frame, y1 + frame))
        return false;
    const float middle = (x0 + x1) / 2, third = y0 + (y1 - y0) * 0.62f;
    const bool pane = inside(x, y, x0, x1, y0, y1) && std::abs(x - middle) > bar && std::abs(y - third) > bar;
    light = pane ? outside_light(y) : vec3(0.60f, 0.59f, 0.56f);
    return true;
}

constexpr float window_edges[2][2] = {{-2.4f, -0.5f}, {0.5f, 2.4f}}; ///< on the back wall, m

/// Light that comes from the windows to a place, in about the unit in which 1 lights a white wall fully: two big lamps
/// without shadows.
float lit(const vec3& p) {
    const vec3 back = p - vec3(0, 0.4f, room_low.z - 0.3f), right = p - vec3(room_high.x + 0.3f, 0.4f, 0);
    return 0.38f + 1.8f / (2 + glm::dot(back, back)) + 1.7f / (2 + glm::dot(right, right));
}

/// The lower the nearer to an edge between two walls, 1 in the open.
float open(float a, float b) {
    return 0.6f + 0.4f * smooth_step(0, 0.7f, std::min(a, b));
}

vec3 wall_light(const vec3& p, int axis, bool high) {
    const float x = axis == 0 ? p.z : p.x, y = p.y;
    vec3 light;
    if (axis == 2 && !high)
        for (const auto& edges : window_edges)
            if (window(x, y, edges[0], edges[1], light))
                return light;
    if (axis == 0 && high && window(x, y, -1.3f, 1.3f, light))
        return light;
    const float brightness = lit(p);
    vec3 paint = axis == 0 ? vec3(0.66f, 0.61f, 0.52f) : vec3(0.52f, 0.60f, 0.60f);
    if (y < room_low.y + 0.12f)
        paint = vec3(0.72f); // skirting board
    if (axis == 2 && high && inside(x, y, -2.3f, -1.3f, room_low.y, 0.75f)) {
        const bool panel = inside(x, y, -2.15f, -1.45f, 0.f, 0.6f) || inside(x, y, -2.15f, -1.45f, -1.1f, -0.2f);
        paint = panel ? vec3(0.27f, 0.13f, 0.06f) : vec3(0.34f, 0.17f, 0.08f); // door
    }
    if (axis == 0 && !high && inside(x, y, -0.95f, 0.95f, -0.25f, 0.95f)) {
        const bool canvas = inside(x, y, -0.87f, 0.87f, -0.17f, 0.87f);
        const float hill = 0.16f + 0.12f * std::sin(3 * x + 0.5f), near_hill = 0.02f + 0.1f * std::sin(2 * x + 3);
        paint = !canvas                                   ? vec3(0.10f, 0.07f, 0.05f)
                : y < near_hill                           ? vec3(0.10f, 0.22f, 0.16f)
                : y < hill                                ? vec3(0.13f, 0.33f, 0.42f)
                : std::hypot(x - 0.4f, y - 0.55f) < 0.14f ? vec3(0.95f, 0.45f, 0.12f)
                                                          : vec3(0.88f, 0.70f, 0.48f);
    }
    const float to_side =
        axis == 0 ? std::min(p.z - room_low.z, room_high.z - p.z) : std::min(p.x - room_low.x, room_high.x - p.x);
    return paint * brightness * open(to_side, std::min(y - room_low.y, room_high.y - y));
}

vec3 room_light(const vec3& d) {
    // Where a ray from the middle leaves the box.
    float distance = 1e9f;
    int axis = 0;
    for (int k = 0; k < 3; ++k) {
        const float to = (d[k] > 0 ? room_high[k] : room_low[k]) / (std::abs(d[k]) < 1e-6f ? 1e-6f : d[k]);
        if (to > 0 && to < distance) {
            distance = to;
            axis = k;
        }
    }
    const vec3 p = d * distance;
    const bool high = d[axis] > 0;
    if (axis != 1)
        return wall_light(p, axis, high);
    const float to_wall =
        std::min(std::min(p.x - room_low.x, room_high.x - p.x), std::min(p.z - room_low.z, room_high.z - p.z));
    const float brightness = lit(p) * open(to_wall, 1);
    if (high) {
        if (std::hypot(p.x, p.z) < 0.42f)
            return vec3(1.2f, 1.1f, 0.95f); // lamp
        const float glow = 0.35f / (1 + 3 * (p.x * p.x + p.z * p.z));
        return vec3(0.78f, 0.77f, 0.74f) * (brightness + glow);
    }
    // Sunlight through the windows at the back, on the floor and on the rug.
    float sun = 0;
    for (const auto& edges : window_edges) {
        const float slanted = p.x - 0.35f * (p.z - room_low.z);
        if (inside(slanted, p.z, edges[0], edges[1], -2.0f, -0.4f) &&
            std::abs(slanted - (edges[0] + edges[1]) / 2) > 0.04f)
            sun = 1.1f;
    }
    const bool rug = inside(p.x, p.z, -1.5f, 1.5f, -0.1f, 1.7f),
               border = rug && !inside(p.x, p.z, -1.35f, 1.35f, 0.05f, 1.55f);
    const vec3 floor = border ? vec3(0.60f, 0.52f, 0.38f) : rug ? vec3(0.30f, 0.055f, 0.05f) : wood(p.x, p.z);
    return floor * (brightness + sun * vec3(1, 0.95f, 0.82f));
}

} // namespace

Cube<Image> sky() {
    return surround(1, sky_light);
}

Cube<Image> room() {
    return surround(2, room_light);
}

Cube<Image> six_colours() {
    static constexpr std::array<unsigned, 6> colours = {0xFF0000, 0x00FFFF, 0x00FF00, 0xFF00FF, 0x0000FF, 0xFFFF00};
    Cube<Image> cube;
    for (std::size_t face = 0; face < 6; ++face)
        cube[face] = paint(size, [&](float, float) { return colour(colours[face]); });
    return cube;
}

} // namespace clothlab::render
