#include "render/procedural_noise.h"

#include <algorithm>
#include <cmath>

namespace clothlab::render {

namespace {

std::uint32_t mix(std::uint32_t h) {
    // C. Wellons' lowbias32 (public domain, nullprogram.com/blog/2018/07/31).
    h = (h ^ h >> 16) * 0x7FEB352Du;
    h = (h ^ h >> 15) * 0x846CA68Bu;
    return h ^ h >> 16;
}

int wrapped(int i, int period) {
    if (i >= 0 && i < period) // no division for most
        return i;
    const int r = i % period;
    return r < 0 ? r + period : r;
}

/// The largest integer that is not above x; std::floor is a call where the processor may be an old one.
int whole(float x) {
    const int i = static_cast<int>(x);
    return static_cast<float>(i) > x ? i - 1 : i;
}

float interpolate(float a, float b, float t) {
    return a + (b - a) * t;
}

/// The quintic of K. Perlin, Improving noise, SIGGRAPH 2002: no kinks in the slope, which bump mapping would show.
float fade(float t) {
    return t * t * t * (t * (t * 6 - 15) + 10);
}

} // namespace

std::uint32_t hash(std::uint32_t x, std::uint32_t y, std::uint32_t seed) {
    return mix(x + mix(y + mix(seed + 0x9E3779B9u)));
}

float random_at(int x, int y, std::uint32_t seed) {
    return static_cast<float>(hash(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), seed) >> 8) * 0x1p-24f;
}

float smooth_step(float from, float to, float x) {
    const float t = std::clamp((x - from) / (to - from), 0.f, 1.f);
    return t * t * (3 - 2 * t);
}

float value_noise(float x, float y, int period_x, int period_y, std::uint32_t seed) {
    const int left = whole(x), top = whole(y);
    const int x0 = wrapped(left, period_x), x1 = x0 + 1 == period_x ? 0 : x0 + 1;
    const int y0 = wrapped(top, period_y), y1 = y0 + 1 == period_y ? 0 : y0 + 1;
    const float tx = fade(x - static_cast<float>(left)), ty = fade(y - static_cast<float>(top));
    return interpolate(interpolate(random_at(x0, y0, seed), random_at(x1, y0, seed), tx),
                       interpolate(random_at(x0, y1, seed), random_at(x1, y1, seed), tx), ty);
}

float fractal_noise(float u, float v, int cells_u, int cells_v, int octaves, std::uint32_t seed) {
    float sum = 0, weights = 0, weight = 1;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += weight * value_noise(u * static_cast<float>(cells_u), v * static_cast<float>(cells_v), cells_u, cells_v,
                                    seed + static_cast<std::uint32_t>(octave));
        weights += weight;
        weight *= 0.5f;
        cells_u *= 2;
        cells_v *= 2;
    }
    return sum / weights;
}

float fractal_noise(float x, float y, float z, int octaves, std::uint32_t seed) {
    constexpr int never = 1 << 30; // a period that no caller reaches
    float sum = 0, weights = 0, weight = 1;
    for (int octave = 0; octave < octaves; ++octave) {
        const int below = whole(z);
        const auto layer = seed + 977u * static_cast<std::uint32_t>(octave) + 31u * static_cast<std::uint32_t>(below);
        sum += weight * interpolate(value_noise(x, y, never, never, layer),
                                    value_noise(x, y, never, never, layer + 31u), fade(z - static_cast<float>(below)));
        weights += weight;
        weight *= 0.5f;
        x *= 2;
        y *= 2;
        z *= 2;
    }
    return sum / weights;
}

Cellular cellular_noise(float u, float v, int cells, std::uint32_t seed) {
    const float x = u * static_cast<float>(cells), y = v * static_cast<float>(cells);
    const int cell_x = whole(x), cell_y = whole(y);
    struct Near {
        float square = 1e9f, dx = 0, dy = 0;
        std::uint32_t id = 0;
    } first, second;
    for (int j = cell_y - 1; j <= cell_y + 1; ++j) {
        for (int i = cell_x - 1; i <= cell_x + 1; ++i) {
            const std::uint32_t h = hash(static_cast<std::uint32_t>(wrapped(i, cells)),
                                         static_cast<std::uint32_t>(wrapped(j, cells)), seed);
            const float dx = static_cast<float>(i) - x + 0.1f + 0.8f * static_cast<float>(h & 0x3FFu) / 1024;
            const float dy = static_cast<float>(j) - y + 0.1f + 0.8f * static_cast<float>(h >> 10 & 0x3FFu) / 1024;
            const Near point{dx * dx + dy * dy, dx, dy, h};
            if (point.square < first.square) {
                second = first;
                first = point;
            } else if (point.square < second.square) {
                second = point;
            }
        }
    }
    const float apart = std::hypot(second.dx - first.dx, second.dy - first.dy);
    return {std::sqrt(first.square), (second.square - first.square) / (2 * apart),
            static_cast<float>(first.id >> 20) / 4096};
}

} // namespace clothlab::render
