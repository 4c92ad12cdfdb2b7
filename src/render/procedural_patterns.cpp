#include "render/procedural_patterns.h"

#include <array>
#include <numbers>

#include "render/options.h"
#include "render/procedural_colour.h"
#include "render/procedural_noise.h"

namespace clothlab::render {

namespace {

constexpr int size = 512; ///< px

using glm::mix;
using glm::vec3;

// --- bricks ----------------------------------------------------------------------------------------------------------

struct BrickPoint {
    int column, row;
    float inside; ///< from the brick's edge inwards, in widths of the picture; negative in the joint
    float grain;  ///< 0 to 1, fine
};

BrickPoint brick_at(float u, float v) {
    constexpr int columns = 4, rows = 10;
    constexpr float half_joint = 0.005f, corner = 0.006f;
    // Edges that are not quite straight.
    const float wave = (fractal_noise(u, v, 16, 16, 2, 11) - 0.5f) * 0.006f;
    const float row_position = v * rows;
    const int row = static_cast<int>(row_position);
    const float column_position = u * columns + (row % 2 == 0 ? 0.f : 0.5f);
    const int whole = static_cast<int>(column_position);
    const float across = std::abs(column_position - static_cast<float>(whole) - 0.5f) / columns;
    const float down = std::abs(row_position - static_cast<float>(row) - 0.5f) / rows;
    // Signed distance to a rectangle with round corners.
    const float dx = across - (0.5f / columns - half_joint - corner), dy = down - (0.5f / rows - half_joint - corner);
    const float outside = std::hypot(std::max(dx, 0.f), std::max(dy, 0.f)) + std::min(std::max(dx, dy), 0.f) - corner;
    return {whole % columns, row, -outside + wave, fractal_noise(u, v, 64, 64, 3, 12)};
}

vec3 brick_colour(float u, float v) {
    static constexpr std::array<vec3, 5> clays = {colour(0xA4563F), colour(0xB4674A), colour(0x924A3A),
                                                  colour(0xBF7A58), colour(0x7C4036)};
    const BrickPoint p = brick_at(u, v);
    const float choice = random_at(p.column, p.row, 13) * 4.99f;
    const vec3 clay = clays[static_cast<std::size_t>(choice)] * (0.9f + 0.2f * random_at(p.column, p.row, 14));
    const float blotches = fractal_noise(u, v, 12, 24, 3, 15);
    const float pits = smooth_step(0.66f, 0.85f, fractal_noise(u, v, 96, 96, 2, 16));
    vec3 brick = clay * (0.72f + 0.32f * p.grain + 0.24f * blotches) * (1 - 0.25f * pits);
    brick *= 0.8f + 0.2f * smooth_step(0, 0.012f, p.inside); // dirt gathers at the edges
    const vec3 mortar = colour(0xB9B0A2) * (0.72f + 0.4f * fractal_noise(u, v, 128, 128, 2, 17)) *
                        (0.78f + 0.22f * smooth_step(0, -0.005f, p.inside));
    return mix(mortar, brick, smooth_step(-0.0015f, 0.0015f, p.inside));
}

float brick_height(float u, float v) {
    const BrickPoint p = brick_at(u, v);
    const float pits = smooth_step(0.66f, 0.85f, fractal_noise(u, v, 96, 96, 2, 16));
    const float brick = 0.8f + 0.1f * random_at(p.column, p.row, 18) + 0.12f * (p.grain - 0.5f) - 0.06f * pits;
    const float mortar = 0.22f + 0.16f * fractal_noise(u, v, 128, 128, 2, 17);
    return mix(mortar, brick, smooth_step(-0.003f, 0.008f, p.inside));
}

// --- woven fabric ----------------------------------------------------------------------------------------------------

struct WeavePoint {
    float height; ///< 0 to 1
    bool warp;    ///< else weft
    int thread;   ///< the thread's number
    float side;   ///< across the thread, -1 to 1
    float gap;    ///< 1 between the threads, where one sees through, else 0
};

constexpr int threads = 28; ///< a side; an even number, so that it tiles

/// How high a round thread stands at `side` of its middle, 0 to 1; negative outside.
float thread_profile(float side) {
    constexpr float half_width = 0.8f;
    const float square = 1 - side * side / (half_width * half_width);
    return square > 0 ? std::sqrt(square) : square;
}

WeavePoint weave_at(float u, float v) {
    constexpr float pi = std::numbers::pi_v<float>;
    // The threads are not quite straight: spun by hand.
    const float x = u * threads + (fractal_noise(u, v, 8, 16, 2, 21) - 0.5f) * 0.22f;
    const float y = v * threads + (fractal_noise(u, v, 16, 8, 2, 22) - 0.5f) * 0.22f;
    const float column = std::floor(x), row = std::floor(y);
    const float side_x = 2 * (x - column) - 1, side_y = 2 * (y - row) - 1;
    const int i = static_cast<int>(column + threads) % threads, j = static_cast<int>(row + threads) % threads;
    // Up and down in sine waves: the warp on top where i + j is even, the weft elsewhere.
    const float warp = thread_profile(side_x), weft = thread_profile(side_y);
    const float warp_height = 0.42f * warp + 0.24f * (i % 2 == 0 ? 1.f : -1.f) * std::sin(pi * y);
    const float weft_height = 0.42f * weft - 0.24f * (j % 2 == 0 ? 1.f : -1.f) * std::sin(pi * x);
    const bool warp_seen = warp >= 0 && (weft < 0 || warp_height >= weft_height);
    if (warp < 0 && weft < 0)
        return {0, false, j, side_y, 1};
    return {0.34f + (warp_seen ? warp_height : weft_height), warp_seen, warp_seen ? i : j, warp_seen ? side_x : side_y,
            0};
}

/// Fibres along a thread, laid slantwise by its twist, 0 to 1.
float fibres(const WeavePoint& p, float along) {
    const int repeats = 8 * threads;
    return value_noise((along * threads + 0.35f * p.side) * 8, p.side * 3 + 40 + static_cast<float>(7 * p.thread),
                       repeats, 1 << 20, p.warp ? 23u : 24u);
}

vec3 weave_colour(float u, float v) {
    const WeavePoint p = weave_at(u, v);
    const vec3 thread = p.warp ? colour(0x5B83B8) : colour(0xE6DCC6);
    const float own = 0.88f + 0.18f * random_at(p.thread, p.warp ? 0 : 1, 25);
    const float depth = smooth_step(0.05f, 1, p.height);
    const float streaks = 0.8f + 0.34f * fibres(p, p.warp ? v : u);
    const vec3 lit = thread * own * streaks * (0.3f + 0.75f * depth);
    return mix(lit, colour(0x20222A), p.gap);
}

float weave_height_at(float u, float v) {
    const WeavePoint p = weave_at(u, v);
    return p.height + 0.06f * (fibres(p, p.warp ? v : u) - 0.5f) * (1 - p.gap);
}

// --- skin ------------------------------------------------------------------------------------------------------------

struct SkinPoint {
    float furrow; ///< 0 on a plateau, 1 at the bottom of a furrow
    float pore, blotches;
    float fine; ///< fine grain, 0 to 1
};

SkinPoint skin_at(float u, float v) {
    // Shifted about a little, or the furrows would be straight lines.
    const float du = (fractal_noise(u, v, 24, 24, 2, 31) - 0.5f) * 0.03f;
    const float dv = (fractal_noise(u, v, 24, 24, 2, 32) - 0.5f) * 0.03f;
    const float x = u + du + 1, y = v + dv + 1;
    const auto wrap = [](float a) { return a - std::floor(a); };
    const Cellular coarse = cellular_noise(wrap(x), wrap(y), 14, 33);
    const Cellular fine = cellular_noise(wrap(x), wrap(y), 36, 34);
    const float deep = 1 - smooth_step(0, 0.17f, coarse.border);
    const float shallow = 1 - smooth_step(0, 0.24f, fine.border);
    const float pore = fine.id > 0.75f ? 1 - smooth_step(0.06f, 0.24f, fine.nearest) : 0.f;
    return {std::max(deep, 0.5f * shallow), pore, fractal_noise(u, v, 4, 4, 4, 35), fractal_noise(u, v, 96, 96, 2, 36)};
}

vec3 skin_colour(float u, float v) {
    const SkinPoint p = skin_at(u, v);
    vec3 tone = mix(colour(0xD79A7C), colour(0xEFC2A2), smooth_step(0.25f, 0.75f, p.blotches));
    tone *= 0.93f + 0.14f * p.fine;
    tone = mix(tone, colour(0xA4614C), 0.55f * p.furrow);
    return mix(tone, colour(0x8A4B3C), 0.5f * p.pore);
}

float skin_height_at(float u, float v) {
    const SkinPoint p = skin_at(u, v);
    return 0.86f - 0.6f * p.furrow - 0.25f * p.pore + 0.1f * (p.fine - 0.5f) + 0.16f * (p.blotches - 0.5f);
}

} // namespace

Image bricks() {
    return paint(size, brick_colour);
}

GreyImage bricks_height() {
    return model(size, brick_height);
}

Image weave() {
    return paint(size, weave_colour);
}

GreyImage weave_height() {
    return model(size, weave_height_at);
}

Image skin() {
    return paint(size, skin_colour);
}

GreyImage skin_height() {
    return model(size, skin_height_at);
}

GreyImage noise_height() {
    // Octaves seldom meet at their ends: spread out to use the range.
    return model(size, [](float u, float v) { return 0.5f + (fractal_noise(u, v, 4, 4, 6, 41) - 0.5f) * 1.4f; });
}

Image checker() {
    return paint(size, [](float u, float v) {
        const bool light = (static_cast<int>(u * 8) + static_cast<int>(v * 8)) % 2 == 1;
        return light ? colour(0xE8E6E1) : colour(0x2E3440);
    });
}

Image white() {
    return {1, 1, {255, 255, 255, 255}};
}

Image toon_ramp() {
    // Linear light of each step, and where it ends; sRGB would darken the shades in between.
    struct Step {
        float end, light;
    };
    static constexpr std::array<Step, 4> steps = {{{0.12f, 0.06f}, {0.4f, 0.3f}, {0.75f, 0.65f}, {2, 1}}};
    Image image{256, 1, {}};
    for (int x = 0; x < 256; ++x) {
        const float at = (static_cast<float>(x) + 0.5f) / 256;
        std::size_t step = 0;
        while (at > steps[step].end)
            ++step;
        append(image, vec3(srgb_from_linear(steps[step].light)));
    }
    return image;
}

} // namespace clothlab::render
