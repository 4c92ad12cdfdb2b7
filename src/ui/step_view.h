// What a panel and the viewport show of the inside of a step, computed from a trace alone: no ImGui, no OpenGL.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "scene/camera.h"
#include "ui/lab.h"

namespace clothlab::ui {

/// How people read a stage's name.
inline constexpr std::array<const char*, sim::stage_count> stage_titles{"Forces", "Integrate", "Self-collision",
                                                                        "Colliders", "Limit"};
/// Colours of arrows, for the picture and for swatches; sRGB. Most are of Okabe and Ito's palette, which colour-blind
/// people tell apart.
inline constexpr std::array<std::array<float, 3>, sim::stage_count> stage_colours{{{0.94f, 0.89f, 0.26f},
                                                                                   {0.34f, 0.71f, 0.91f},
                                                                                   {0.96f, 0.56f, 0.80f},
                                                                                   {0.18f, 0.80f, 0.56f},
                                                                                   {0.97f, 0.97f, 0.97f}}};

/// The trace that belongs to what the lab shows: of the step after its snapshot, while paused and looked into; null
/// otherwise.
const sim::StepTrace* shown_trace(const Lab& lab);

/// What a stage did to a point, in m: how far it moved it, or, for the forces, how far the point's force alone, acting
/// throughout the step, moves it from rest as Verlet counts: f dt² / m.
sim::Vec3 effect(const sim::StepTrace& trace, sim::Stage stage, std::uint32_t point);
/// The mean distance of neighbours in rows and columns, in m.
double mean_spacing(int columns, int rows, std::span<const float> positions);

/// How many times longer than a stage's effects arrows are to be drawn so that they are seen and stay apart, on a cloth
/// whose points are `spacing` m apart: 1.5 times as long as that in the root mean square over the points that it has an
/// effect on, and none longer than six times. A point alone: five times. None where there is no effect.
std::optional<float> fitting_scale(const sim::StepTrace& trace, sim::Stage stage, std::optional<std::uint32_t> point,
                                   double spacing);

/// The next stage that the model has in a direction, from one of sim::Stage or -1, the state before the step; itself
/// where there is none.
int next_stage(const sim::StepTrace& trace, int stage, int direction);

/// The point (x, y, z each, in m) nearest to a pixel of a picture whose left upper corner is 0, 0: within `reach` px,
/// and of those that are within 3 px as near as it is the one nearest to the eye.
std::optional<std::uint32_t> pick_point(const scene::Camera& camera, float width, float height,
                                        std::span<const float> positions, float x, float y, float reach = 24);

} // namespace clothlab::ui
