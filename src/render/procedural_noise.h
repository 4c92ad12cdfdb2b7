// Noise from integer hashes: the same on every machine, and tiling with the unit square. For textures made by code.
#pragma once

#include <cstdint>

namespace clothlab::render {

/// A well mixed 32-bit number for three integers.
std::uint32_t hash(std::uint32_t x, std::uint32_t y, std::uint32_t seed);
/// The same as a number from 0 to below 1.
float random_at(int x, int y, std::uint32_t seed);

/// 0 below `from`, 1 above `to`, and a smooth cubic between.
float smooth_step(float from, float to, float x);

/// Value noise, 0 to 1: random values at integer points, smoothly interpolated. Repeats after period_x and period_y,
/// both at least 1.
float value_noise(float x, float y, int period_x, int period_y, std::uint32_t seed);

/// Octaves of value noise over the unit square, each twice as fine and half as strong; `cells` cells across in the
/// first. About 0 to 1 with a mean of 0.5; repeats after 1.
float fractal_noise(float u, float v, int cells_u, int cells_v, int octaves, std::uint32_t seed);

/// The same in space, without a period, for directions.
float fractal_noise(float x, float y, float z, int octaves, std::uint32_t seed);

/// Cellular noise (S. Worley, A cellular texture basis function, SIGGRAPH 1996) of points that lie scattered, one in
/// each of cells x cells over the unit square. Lengths are in widths of a cell.
struct Cellular {
    float nearest; ///< to the nearest point
    float border;  ///< to the line halfway between the nearest two points
    float id;      ///< a random number, 0 to 1, of the nearest point
};
Cellular cellular_noise(float u, float v, int cells, std::uint32_t seed);

} // namespace clothlab::render
