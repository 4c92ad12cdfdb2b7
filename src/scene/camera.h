// What can be done with a camera: named sides to look from, fitting it to what is to be seen, and the way from one
// camera to another.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "scene/scene.h"

namespace clothlab::scene {

/// Where a camera can look from at the press of a key.
enum class Side : std::uint8_t { front, back, right, left, top, three_quarter };

struct SideInfo {
    Side side;
    std::string_view name;
    double yaw, pitch; ///< degrees, as in Camera
};
/// All sides, in the order of Side.
std::span<const SideInfo> sides();

/// The camera turned to look from a side; target, distance, field of view and projection stay.
Camera seen_from(Camera camera, Side side);

/// A box along the axes, in m.
struct Box {
    sim::Vec3 low, high;
};
/// Around the scene as it starts: the cloth, the room it has to fall, and the spheres.
Box start_box(const sim::Description& description);

/// The camera moved along with its target so that the whole box is seen, as large as it can be in a square picture;
/// direction, field of view and projection stay.
Camera fitted(Camera camera, const Box& box);
/// The same for points, x, y, z of each in m. Points that are not finite or more than 1 km from the origin do not
/// count; without any other the camera stays as it is.
Camera fitted(Camera camera, std::span<const float> points);

/// The nearest and the furthest that a camera is brought by hand or by fitting, in m.
inline constexpr double min_distance = 0.02, max_distance = 1000;

/// The height, in m, that a picture's shorter side spans at the target; the same in both projections, so that
/// switching between them changes no size there.
double height_at_target(const Camera& camera);

/// A camera on the way, turning the short way round; `share` 0 is `from` and 1 is `to`, exactly. The projection is
/// that of `to`.
Camera between(const Camera& from, const Camera& to, double share);

} // namespace clothlab::scene
