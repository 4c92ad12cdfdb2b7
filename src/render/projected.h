// Where the cloth is in the picture, computed on the CPU: what a draw reports and how wide lines may be. Needs no GL.
#pragma once

#include <cstdint>
#include <span>

#include "render/view.h"
#include "sim/snapshot.h"

namespace clothlab::render {

/// Pixels from the left and the top; the box is around the points inside the view and empty (max < min) without any.
struct ProjectedCloth {
    int min_x = 0, min_y = 0, max_x = -1, max_y = -1;
    std::size_t inside = 0;          ///< points inside the view
    float nearest = 0, furthest = 0; ///< distance of the points inside from the eye's plane, in m
    float cell = 0;                  ///< px, the mean distance of neighbours inside the view; 0 without any
};

/// Projects a snapshot's points (none for a null pointer, nor those with drawn[i] == 0) into a picture.
ProjectedCloth project(const sim::Snapshot* snapshot, std::span<const std::uint8_t> drawn, const View& view, int width,
                       int height);

} // namespace clothlab::render
