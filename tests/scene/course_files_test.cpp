// The course's scene files, and our own in scenes/, are read exactly as they stand.
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <nlohmann/json.hpp>

#include "scene/fields.h"
#include "scene/io.h"
#include "support/files.h"

using namespace clothlab;
using namespace clothlab::test;
using nlohmann::ordered_json;

namespace {

sim::Vec3 vec3(const ordered_json& j) {
    return {j[0], j[1], j[2]};
}

sim::Collider collider(const std::string& kind, const ordered_json& j) {
    if (kind == "sphere")
        return sim::Sphere{vec3(j["origin"]), j["radius"], j.value("friction", 0.0)};
    REQUIRE(kind == "plane");
    return sim::Plane{vec3(j["point"]), vec3(j["normal"]), j.value("friction", 0.0)};
}

/// Compares a field with the file's value.
void require_field(const scene::Scene& scene, const scene::Field& f, const ordered_json& value) {
    INFO(f.key);
    if (f.get_vector)
        REQUIRE(f.get_vector(scene) == vec3(value));
    else if (f.get_text)
        REQUIRE(f.get_text(scene) == value.get<std::string>());
    else if (value.is_boolean())
        REQUIRE((f.get(scene) != 0) == value.get<bool>());
    else if (value.is_string())
        REQUIRE(f.choices[static_cast<std::size_t>(f.get(scene))] == value.get<std::string>());
    else
        REQUIRE(f.get(scene) == value.get<double>());
}

/// Reads the file a second time, by hand, and compares every value; what it leaves out has its default.
void require_as_written(const scene::Scene& scene, const std::filesystem::path& file) {
    INFO(file.string());
    const ordered_json json = ordered_json::parse(read_file(file));
    const scene::Scene standard;
    for (const scene::Field& f : scene::fields()) {
        const auto section = json.find(std::string(f.section()));
        const bool given = section != json.end() && section->contains(std::string(f.name()));
        INFO(f.key);
        if (given)
            require_field(scene, f, section->at(std::string(f.name())));
        else if (f.get)
            REQUIRE(f.get(scene) == f.get(standard));
        else if (f.get_vector)
            REQUIRE(f.get_vector(scene) == f.get_vector(standard));
        else
            REQUIRE(f.get_text(scene) == f.get_text(standard));
    }
    std::vector<sim::GridPoint> pinned;
    if (json["cloth"].contains("pinned"))
        for (const auto& pin : json["cloth"]["pinned"])
            pinned.push_back({pin[0], pin[1]});
    REQUIRE(scene.simulation.cloth.pinned == pinned);
    std::vector<sim::Vec3> accelerations;
    if (json.contains("simulation") && json["simulation"].contains("accelerations"))
        for (const auto& a : json["simulation"]["accelerations"])
            accelerations.push_back(vec3(a));
    REQUIRE(scene.simulation.stepping.accelerations == accelerations);
    std::vector<sim::Collider> colliders;
    for (const auto& [key, value] : json.items()) {
        if (key == "sphere" || key == "plane")
            colliders.push_back(collider(key, value));
        if (key == "colliders")
            for (const auto& c : value)
                colliders.push_back(collider(c["type"], c));
    }
    REQUIRE(scene.simulation.colliders == colliders);
    REQUIRE(scene.name == json.value("name", file.stem().string()));
    REQUIRE(scene.description == json.value("description", ""));
}

/// The course's default scene, as the assignment states it.
sim::Description course_defaults() {
    sim::Description d;
    d.cloth.width = d.cloth.height = 1;
    d.cloth.num_width_points = d.cloth.num_height_points = 50;
    d.cloth.thickness = 0.0095;
    d.cloth.ks = 5000;
    d.cloth.density = 150;
    d.cloth.damping = 0.2;
    d.stepping.frames_per_second = 90;
    d.stepping.substeps = 30;
    d.stepping.gravity = {0, -9.8, 0};
    return d;
}

/// A course scene's cloth, with a plane and a sphere in either order.
std::string with_colliders(bool sphere_first) {
    const std::string sphere = R"("sphere": {"origin": [1, 2, 3], "radius": 0.5, "friction": 0.25})";
    const std::string plane = R"("plane": {"point": [0, -1, 0], "normal": [0, 2, 0], "friction": 1})";
    std::string cloth = read_file(checkout() / "tests/data/cs184-pinned2.json");
    cloth = cloth.substr(0, cloth.rfind('}'));
    return cloth + ", " + (sphere_first ? sphere + ", " + plane : plane + ", " + sphere) + "}";
}

} // namespace

TEST_CASE("The course's pinned cloth is read unmodified, with the course's defaults") {
    const auto file = checkout() / "tests/data/cs184-pinned2.json";
    const scene::Scene scene = scene::load_scene(file);
    sim::Description expected = course_defaults();
    expected.cloth.pinned = {{0, 0}, {49, 0}};
    REQUIRE(scene.simulation == expected);
    REQUIRE(scene.name == "cs184-pinned2");
    REQUIRE_FALSE(scene.camera);
    require_as_written(scene, file);
}

TEST_CASE("The course's sphere scene is read unmodified, with the course's defaults") {
    const auto file = checkout() / "tests/data/cs184-sphere.json";
    const scene::Scene scene = scene::load_scene(file);
    sim::Description expected = course_defaults();
    expected.colliders = {sim::Sphere{{0.5, 0.2, 0.5}, 0.2, 0.3}};
    REQUIRE(scene.simulation == expected);
    require_as_written(scene, file);
}

TEST_CASE("The course's defaults are those of an empty description") {
    REQUIRE(sim::Description{} == course_defaults());
    REQUIRE(sim::Description{}.rules == sim::Rules{});
    REQUIRE(sim::Description{}.wind.kind == sim::WindKind::none);
    REQUIRE(scene::read_scene(R"({"clothlab": 1})", "text").simulation == course_defaults());
}

TEST_CASE("Every shipped scene is read exactly as it stands in its file") {
    const auto files = files_of(checkout() / "scenes");
    REQUIRE(files.size() >= 10);
    for (const auto& file : files) {
        const scene::Scene scene = scene::load_scene(file);
        require_as_written(scene, file);
        CHECK_FALSE(scene.description.empty());
        scene::check(scene, file.string());
        // What is written of it is the same scene.
        CHECK(scene::read_scene(scene::write_scene(scene), "written") == scene);
    }
}

TEST_CASE("Sphere and plane keep the order of the file, which is the order of contact") {
    const auto first = scene::read_scene(with_colliders(true), "text").simulation.colliders;
    const auto second = scene::read_scene(with_colliders(false), "text").simulation.colliders;
    REQUIRE(first ==
            std::vector<sim::Collider>{sim::Sphere{{1, 2, 3}, 0.5, 0.25}, sim::Plane{{0, -1, 0}, {0, 2, 0}, 1}});
    REQUIRE(second == std::vector<sim::Collider>{first[1], first[0]});
    const auto own = scene::read_scene(R"({"clothlab": 1, "plane": {"point": [0, 0, 0], "normal": [1, 0, 0]},
        "colliders": [{"type": "sphere", "origin": [0, 0, 0], "radius": 1}, {"type": "plane", "point": [1, 1, 1],
        "normal": [0, 0, 1]}], "sphere": {"origin": [5, 5, 5], "radius": 2}})",
                                       "text");
    REQUIRE(own.simulation.colliders ==
            std::vector<sim::Collider>{sim::Plane{{0, 0, 0}, {1, 0, 0}, 0}, sim::Sphere{{0, 0, 0}, 1, 0},
                                       sim::Plane{{1, 1, 1}, {0, 0, 1}, 0}, sim::Sphere{{5, 5, 5}, 2, 0}});
}

TEST_CASE("A byte order mark before a scene is read over") {
    const std::string text = read_file(checkout() / "tests/data/cs184-pinned2.json");
    REQUIRE(scene::read_scene("\xef\xbb\xbf" + text, "text") == scene::read_scene(text, "text"));
}

TEST_CASE("Whole numbers may be written as 1.0 or 1e1") {
    const auto scene = scene::read_scene(
        R"({"clothlab": 1, "cloth": {"num_width_points": 1e1, "pinned": [[9.0, 0]]}, "simulation": {"substeps": 7.0}})",
        "text");
    REQUIRE(scene.simulation.cloth.num_width_points == 10);
    REQUIRE(scene.simulation.cloth.pinned == std::vector<sim::GridPoint>{{9, 0}});
    REQUIRE(scene.simulation.stepping.substeps == 7);
}
