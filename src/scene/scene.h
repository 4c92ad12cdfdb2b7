// A scene: what is simulated and how it is looked at. The one definition that the window, the command line, the tests
// and benchmarks share.
#pragma once

#include <optional>
#include <string>

#include "sim/description.h"

namespace clothlab::scene {

/// An orbit camera: it looks at a target from a distance, turned by yaw about the vertical and by pitch above it.
struct Camera {
    sim::Vec3 target{0.5, 0.6, 0.5}; ///< m
    double distance = 2.2;           ///< m
    double yaw = 30;                 ///< degrees; 0 looks from +z, 90 from +x
    double pitch = 20;               ///< degrees above the horizon
    double fov = 45;                 ///< degrees, across the shorter side of the picture
    bool operator==(const Camera&) const = default;
};

/// The camera's place in m, and its right and up directions (unit vectors).
struct CameraFrame {
    sim::Vec3 eye, right, up;
};
CameraFrame frame(const Camera& camera);

/// A camera that sees the whole scene as it starts: the cloth, the room it has to fall, and the spheres.
Camera fitting_camera(const sim::Description& description);

/// How the scene is drawn.
struct Look {
    std::string shader = "diffuse";
    bool show_structural = true; ///< springs, in wireframe and over the surface
    bool show_shearing = true;
    bool show_bending = true;
    bool springs_over_surface = false;
    bool show_pins = true;
    bool show_colliders = true;
    int sphere_latitude_lines = 40;
    int sphere_longitude_lines = 40;
    bool operator==(const Look&) const = default;
};

struct Scene {
    std::string name;
    std::string description;
    sim::Description simulation;
    std::optional<Camera> camera; ///< without one, the scene is shown by fitting_camera
    Look look;
    bool operator==(const Scene&) const = default;
};

/// The scene's camera, or the fitting one.
Camera camera_of(const Scene& scene);

} // namespace clothlab::scene
