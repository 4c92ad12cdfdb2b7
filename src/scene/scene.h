// A scene: what is simulated and how it is looked at. The one definition that the window, the command line, the tests
// and benchmarks share.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>

#include "sim/description.h"

namespace clothlab::scene {

/// Perspective: what is further away is smaller. Orthographic: sizes can be compared, parallel lines stay parallel.
enum class Projection : std::uint8_t { perspective, orthographic };

/// An orbit camera: it looks at a target from a distance, turned by yaw about the vertical and by pitch above it.
struct Camera {
    sim::Vec3 target{0.5, 0.6, 0.5};                 ///< m
    double distance = 2.2;                           ///< m
    double yaw = 30;                                 ///< degrees; 0 looks from +z, 90 from +x
    double pitch = 20;                               ///< degrees above the horizon
    double fov = 45;                                 ///< degrees, across the shorter side of the picture
    Projection projection = Projection::perspective; ///< both show what is at the target in the same size
    bool operator==(const Camera&) const = default;
};

/// The camera's place in m, and its right and up directions (unit vectors).
struct CameraFrame {
    sim::Vec3 eye, right, up;
};
CameraFrame frame(const Camera& camera);

/// A camera that sees the whole scene as it starts: the cloth, the room it has to fall, and the spheres.
Camera fitting_camera(const sim::Description& description);

/// A value of a shader's parameter: a number, a switch, a colour (sRGB, 0 to 1 each), or a text (a texture's name).
using ShaderValue = std::variant<double, bool, sim::Vec3, std::string>;
using ShaderValues = std::map<std::string, ShaderValue>; ///< by the parameter's name

/// The view of two shaders, or of two spheres of other coarseness, in one picture: what is on the right of the divider.
struct SplitView {
    bool on = false;
    double position = 0.5; ///< of the divider, as a share of the picture's width
    std::string shader = "wireframe";
    int sphere_latitude_lines = 40;
    int sphere_longitude_lines = 40;
    bool operator==(const SplitView&) const = default;
};

/// A lamp: the light that arrives at distance r is intensity / r².
struct Lamp {
    sim::Vec3 position;   ///< m
    double intensity = 0; ///< at 1 m, in the unit in which 1 lights a white surface fully; 0: off
    bool operator==(const Lamp&) const = default;
};

/// What the drawn spheres look like: plain and grey, or with the cloth's shader.
enum class SphereLook : std::uint8_t { plain, cloth };
/// Samples per pixel: automatic is four, one on the screen of a machine that draws on its CPU.
enum class Multisampling : std::uint8_t { automatic, off, two, four, eight };

/// How the scene is drawn.
struct Look {
    std::string shader = "diffuse";
    /// Values of shaders' parameters where they are not the shader's own defaults, by the shader's name.
    std::map<std::string, ShaderValues> shaders;
    bool show_structural = true; ///< springs, in wireframe and over the surface
    bool show_shearing = true;
    bool show_bending = true;
    bool springs_over_surface = false;
    bool show_pins = true;
    bool show_colliders = true;
    SphereLook sphere = SphereLook::plain;
    int sphere_latitude_lines = 40;
    int sphere_longitude_lines = 40;
    SplitView split;
    Lamp lamp{{1.9, 3.2, 2.6}, 9.5};
    Lamp second_lamp{{-1.5, 2, 1.5}, 0};
    double ambient = 0.16; ///< light from everywhere; 1 lights a white surface fully
    double fill = 0.36;    ///< light from over the beholder's left shoulder, in the same unit
    bool shadow = true;    ///< of the first lamp
    bool ground_grid = false;
    Multisampling multisampling = Multisampling::automatic;
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
