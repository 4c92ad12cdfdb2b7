// The orbit camera: where it stands, and how it is read.
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>

#include "scene/camera.h"
#include "scene/io.h"
#include "support/effort.h"
#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

sim::Vec3 cross(sim::Vec3 a, sim::Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// How far from the middle of a square picture a point is seen: 1 is the edge; infinite behind the camera.
double from_the_middle(const scene::Camera& camera, sim::Vec3 point) {
    const scene::CameraFrame f = scene::frame(camera);
    const sim::Vec3 d = minus(point, f.eye);
    const double depth = -dot(d, cross(f.right, f.up));
    const bool orthographic = camera.projection == scene::Projection::orthographic;
    const double half = (orthographic ? camera.distance : depth) * std::tan(camera.fov / 2 * std::acos(-1.0) / 180);
    return depth > 0 || orthographic ? std::max(std::abs(dot(d, f.right)), std::abs(dot(d, f.up))) / half : HUGE_VAL;
}

scene::Camera random_camera(sim::SplitMix64& random) {
    scene::Camera camera{uniform_point(random, -3, 3), uniform(random, 0.1, 50), uniform(random, -720, 720),
                         uniform(random, -90, 90), uniform(random, 1, 170)};
    if (uniform(random, 0, 1) < 0.5)
        camera.projection = scene::Projection::orthographic;
    return camera;
}

std::string camera_error(const std::string& text) {
    try {
        scene::read_camera(text, "camera.json");
    } catch (const scene::SceneError& e) {
        return e.what();
    }
    return "";
}

} // namespace

TEST_CASE("A camera's frame is orthonormal and looks at its target, upright, from any side") {
    sim::SplitMix64 random(3);
    for (int i = 0; i < attempts(1000); ++i) {
        scene::Camera camera;
        camera.target = uniform_point(random, -3, 3);
        camera.distance = uniform(random, 0.1, 50);
        camera.yaw = uniform(random, -720, 720);
        camera.pitch = i % 10 == 0 ? 90 : i % 10 == 1 ? -90 : uniform(random, -90, 90);
        const scene::CameraFrame f = scene::frame(camera);
        REQUIRE(std::abs(norm(f.right) - 1) < 1e-12);
        REQUIRE(std::abs(norm(f.up) - 1) < 1e-12);
        REQUIRE(std::abs(dot(f.right, f.up)) < 1e-12);
        REQUIRE(f.right.y == 0);  // the horizon is level
        REQUIRE(f.up.y > -1e-15); // and the sky above
        const sim::Vec3 back = cross(f.right, f.up), to_eye = minus(f.eye, camera.target);
        REQUIRE(norm(minus(to_eye, {back.x * camera.distance, back.y * camera.distance, back.z * camera.distance})) <
                1e-12 * camera.distance + 1e-14);
    }
}

TEST_CASE("Yaw 0 looks from +z, yaw 90 from +x, pitch 90 from above") {
    const auto eye = [](double yaw, double pitch) {
        return scene::frame({.target = {1, 2, 3}, .distance = 2, .yaw = yaw, .pitch = pitch, .fov = 45}).eye;
    };
    REQUIRE(norm(minus(eye(0, 0), {1, 2, 5})) < 1e-12);
    REQUIRE(norm(minus(eye(90, 0), {3, 2, 3})) < 1e-12);
    REQUIRE(norm(minus(eye(0, 90), {1, 4, 3})) < 1e-12);
}

TEST_CASE("The fitting camera sees the whole cloth, where it may fall to, and the spheres") {
    sim::SplitMix64 random(5);
    for (int i = 0; i < attempts(300); ++i) {
        sim::Description d;
        d.cloth.width = uniform(random, 0.1, 3);
        d.cloth.height = uniform(random, 0.1, 3);
        d.cloth.offset = uniform_point(random, -2, 2);
        const bool vertical = i % 2 == 0;
        if (vertical)
            d.cloth.orientation = sim::Orientation::vertical;
        std::vector<sim::Vec3> points;
        const sim::Vec3 o = d.cloth.offset;
        for (const double u : {0.0, d.cloth.width})
            for (const double v : {0.0, d.cloth.height}) {
                points.push_back(vertical ? sim::Vec3{o.x + u, o.y + v, o.z} : sim::Vec3{o.x + u, o.y + 1, o.z + v});
                if (!vertical && i % 3 == 0) // hanging from two pins
                    points.push_back({o.x + u, o.y + 1 - d.cloth.height, o.z});
            }
        if (i % 3 != 0) {
            const sim::Sphere sphere{uniform_point(random, -1, 1), uniform(random, 0.1, 1), 0};
            d.colliders = {sphere};
            for (const double side : {-1.0, 1.0}) {
                points.push_back({sphere.origin.x + side * sphere.radius, sphere.origin.y, sphere.origin.z});
                points.push_back({sphere.origin.x, sphere.origin.y + side * sphere.radius, sphere.origin.z});
            }
        }
        const scene::Camera camera = scene::fitting_camera(d);
        for (const sim::Vec3& p : points)
            REQUIRE(from_the_middle(camera, p) < 1);
        // Nor does it stand so far off that the cloth is lost.
        REQUIRE(camera.distance < 20);
    }
}

TEST_CASE("A fitted camera looks from where it did and sees all points, the outermost near the edge") {
    sim::SplitMix64 random(9);
    for (int i = 0; i < attempts(300); ++i) {
        const scene::Camera before = random_camera(random);
        std::vector<float> points;
        for (int k = 0; k < 300; ++k)
            points.push_back(static_cast<float>(uniform(random, -1, 2)));
        points.insert(points.end(), {std::nanf(""), 0, 0, 0, 1e9f, 0}); // a cloth of which some blew up
        const scene::Camera camera = scene::fitted(before, points);
        REQUIRE(camera.yaw == before.yaw);
        REQUIRE(camera.pitch == before.pitch);
        REQUIRE(camera.fov == before.fov);
        REQUIRE(camera.projection == before.projection);
        double outermost = 0;
        for (std::size_t k = 0; k < 300; k += 3)
            outermost = std::max(
                outermost, from_the_middle(camera, {static_cast<double>(points[k]), static_cast<double>(points[k + 1]),
                                                    static_cast<double>(points[k + 2])}));
        REQUIRE(outermost < 1);
        // A wide lens magnifies what is nearest, and with it the margin.
        REQUIRE((outermost > 0.8 || before.fov > 60));
    }
    const std::vector<float> lost{std::nanf(""), 0, 0};
    REQUIRE(scene::fitted(scene::Camera{.yaw = 4}, lost) == scene::Camera{.yaw = 4});
}

TEST_CASE("A camera on its way is exactly at both ends, and turns the short way round") {
    sim::SplitMix64 random(11);
    for (int i = 0; i < attempts(300); ++i) {
        const scene::Camera from = random_camera(random), to = random_camera(random);
        REQUIRE(scene::between(from, to, 1) == to);
        scene::Camera start = scene::between(from, to, 0);
        REQUIRE(start.projection == to.projection);
        start.projection = from.projection;
        REQUIRE(start == from);
        const scene::Camera half = scene::between(from, to, 0.5);
        REQUIRE(std::abs(half.yaw - from.yaw) <= 90);
        REQUIRE(std::abs(std::remainder(half.yaw - to.yaw, 360.0)) <= 90 + 1e-9);
        REQUIRE(std::abs(half.distance * half.distance - from.distance * to.distance) < 1e-9);
    }
}

TEST_CASE("A written camera is read back to the last bit") {
    sim::SplitMix64 random(13);
    for (int i = 0; i < attempts(300); ++i) {
        const scene::Camera camera = random_camera(random);
        REQUIRE(scene::read_camera(scene::write_camera(camera), "camera.json") == camera);
    }
}

TEST_CASE("A scene is shown by its own camera, and without one by the fitting one") {
    scene::Scene scene;
    REQUIRE(scene::camera_of(scene) == scene::fitting_camera(scene.simulation));
    scene.camera = scene::Camera{.distance = 7};
    REQUIRE(scene::camera_of(scene).distance == 7);
}

TEST_CASE("A camera file has the keys of a scene's camera, what it leaves out has its default") {
    const scene::Camera camera =
        scene::read_camera(R"({"target": [1, 2, 3], "distance": 4, "yaw": -5, "pitch": 6, "fov": 70})", "camera.json");
    REQUIRE(camera == scene::Camera{{1, 2, 3}, 4, -5, 6, 70});
    REQUIRE(scene::read_camera(R"({"projection": "orthographic"})", "camera.json") ==
            scene::Camera{.projection = scene::Projection::orthographic});
    REQUIRE(scene::read_camera("{}", "camera.json") == scene::Camera{});
    REQUIRE(scene::read_camera(R"({"yaw": 1})", "camera.json") == scene::Camera{.yaw = 1});
}

TEST_CASE("A bad camera file is refused with its place") {
    REQUIRE(camera_error("{\n\"distance\": 0}").find("camera.json:2: camera.distance: 0 is not allowed") == 0);
    REQUIRE(camera_error("{\"fov\": 180}").find("from 1 to 170") != std::string::npos);
    REQUIRE(camera_error("{\"pitch\": 91}").find("from -90 to 90") != std::string::npos);
    REQUIRE(camera_error("{\"jaw\": 1}").find("did you mean \"yaw\"?") != std::string::npos);
    REQUIRE(camera_error("{\"projection\": \"oblique\"}").find("perspective") != std::string::npos);
    REQUIRE(camera_error("[]").find("an object") != std::string::npos);
    REQUIRE(camera_error("").find("camera.json") == 0);
    REQUIRE(camera_error("{\"target\": 1}").find("three numbers") != std::string::npos);
}
