// --set: every parameter by its key, as on the command line.
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
#include <charconv>

#include "scene/fields.h"
#include "scene/io.h"
#include "support/effort.h"
#include "support/random_scene.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

std::string digits(double value) {
    char text[40];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// A field's value as a user would write it.
std::string argument(const scene::Scene& s, const scene::Field& f) {
    switch (f.type) {
    case scene::FieldType::text:
        return f.get_text(s);
    case scene::FieldType::vector: {
        const sim::Vec3 v = f.get_vector(s);
        return digits(v.x) + "," + digits(v.y) + "," + digits(v.z);
    }
    case scene::FieldType::boolean:
        return f.get(s) != 0 ? "true" : "false";
    case scene::FieldType::choice:
        if (!f.choice_as_integer)
            return std::string(f.choices[static_cast<std::size_t>(f.get(s))]);
        [[fallthrough]];
    default:
        return digits(f.get(s));
    }
}

scene::Scene with(std::string_view key, std::string_view value, scene::Scene scene = {}) {
    scene::set_parameter(scene, key, value);
    return scene;
}

/// A scene with a sphere, a plane and a second sphere.
scene::Scene collision_scene() {
    scene::Scene scene;
    scene.simulation.colliders = {sim::Sphere{{1, 2, 3}, 4, 0.5}, sim::Plane{{0, 0, 0}, {0, 1, 0}, 0.25},
                                  sim::Sphere{{5, 5, 5}, 1, 0}};
    return scene;
}

/// Expects a refusal that begins with the argument and has all of these parts, and a scene left as it was.
void require_refused(const std::string& key, const std::string& value, const std::vector<std::string>& parts,
                     scene::Scene scene = collision_scene()) {
    const scene::Scene before = scene;
    std::string error;
    try {
        scene::set_parameter(scene, key, value);
    } catch (const scene::SceneError& e) {
        error = e.what();
    }
    INFO(key << "=" << value << " -> " << error);
    REQUIRE(error.rfind("--set " + key + "=" + value + ": ", 0) == 0);
    for (const std::string& part : parts) {
        INFO(part);
        REQUIRE(error.find(part) != std::string::npos);
    }
    REQUIRE(error.find(":1:") == std::string::npos); // an argument has no lines
    REQUIRE(scene == before);
}

} // namespace

TEST_CASE("Every parameter can be set by its key to any value that it allows, and changes nothing else") {
    for (const scene::Field& f : scene::fields()) {
        INFO(f.key);
        RandomScene random(7);
        for (int i = 0; i < attempts(200); ++i) {
            scene::Scene wanted;
            wanted.camera.emplace();
            const scene::Scene start = wanted;
            random.set(wanted, f);
            if (f.type == scene::FieldType::text)
                f.set_text(wanted, i % 2 == 0 ? "toon" : "dark red"); // as it is written, without quotes
            const std::string text = argument(wanted, f);
            INFO(text);
            REQUIRE(with(f.key, text, start) == wanted);
        }
    }
}

TEST_CASE("Vectors are set with and without brackets and spaces") {
    for (const char* value : {"1,-2,3e-3", "[1,-2,3e-3]", "1, -2, 0.003", " [ 1 , -2 , 3e-3 ] "})
        REQUIRE(with("simulation.gravity", value).simulation.stepping.gravity == sim::Vec3{1, -2, 0.003});
}

TEST_CASE("Choices are set by name, and the orientation by its number as in files") {
    REQUIRE(with("simulation.precision", "double").simulation.stepping.precision == sim::Precision::double_precision);
    REQUIRE(with("simulation.precision", "\"double\"").simulation.stepping.precision ==
            sim::Precision::double_precision);
    REQUIRE(with("wind.kind", "physical").simulation.wind.kind == sim::WindKind::physical);
    REQUIRE(with("rules.limit", "off").simulation.rules.limit == sim::LimitRule::off);
    REQUIRE(with("cloth.orientation", "1").simulation.cloth.orientation == sim::Orientation::vertical);
    REQUIRE(with("simulation.integrator", "course-verlet") == scene::Scene{});
}

TEST_CASE("rules=cs184 sets all rules at once, a name that not every rule has is refused") {
    scene::Scene scene = collision_scene();
    scene.simulation.rules = {.limit = sim::LimitRule::off, .self_collision = sim::SelfCollisionRule::none};
    require_refused("rules", "off", {"cs184", "rules.limit=off"}, scene);
    require_refused("rules", "none", {"cs184"}, scene);
    require_refused("rules", "184", {"cs184"}, scene);
    REQUIRE(with("rules", "cs184", scene) == collision_scene());
}

TEST_CASE("rules=physical sets every rule to its physical value: no limit, Coulomb's friction, all neighbours") {
    const sim::Rules physical{.damping = sim::DampingRule::physical,
                              .start = sim::StartRule::physical,
                              .limit = sim::LimitRule::off,
                              .friction = sim::FrictionRule::physical,
                              .plane = sim::PlaneRule::physical,
                              .self_collision = sim::SelfCollisionRule::neighbours};
    scene::Scene wanted = collision_scene();
    wanted.simulation.rules = physical;
    REQUIRE(with("rules", "physical", collision_scene()) == wanted);
    REQUIRE(with("rules", "\"physical\"", collision_scene()) == wanted);
    wanted.simulation.rules.limit = sim::LimitRule::iterated; // and single ones on top
    REQUIRE(with("rules.limit", "iterated", with("rules", "physical", collision_scene())) == wanted);
    REQUIRE(with("rules", "cs184", wanted) == collision_scene());
}

TEST_CASE("Every value of every rule is set by its name, in files and as an argument, and changes no other rule") {
    const std::vector<std::pair<std::string, std::vector<std::string>>> rules{
        {"damping", {"cs184", "physical"}},      {"start", {"cs184", "physical"}},
        {"limit", {"cs184", "off", "iterated"}}, {"friction", {"cs184", "physical"}},
        {"plane", {"cs184", "physical"}},        {"self_collision", {"cs184", "none", "neighbours", "triangles"}}};
    for (const auto& [rule, values] : rules) {
        const scene::Field* field = scene::find_field("rules." + rule);
        REQUIRE(field != nullptr);
        REQUIRE(field->choices.size() == values.size());
        for (std::size_t n = 0; n < values.size(); ++n) {
            INFO(rule << " = " << values[n]);
            scene::Scene wanted;
            field->set(wanted, static_cast<double>(n));
            REQUIRE(with("rules." + rule, values[n]) == wanted);
            const std::string file = "{\"clothlab\": 1, \"rules\": {\"" + rule + "\": \"" + values[n] + "\"}}";
            REQUIRE(scene::read_scene(file, "text").simulation.rules == wanted.simulation.rules);
        }
        require_refused("rules." + rule, "sometimes", values);
    }
}

TEST_CASE("Pins and accelerations are set as lists, and emptied") {
    scene::Scene scene = with("cloth.pinned", "[[0,0],[49,3]]");
    REQUIRE(scene.simulation.cloth.pinned == std::vector<sim::GridPoint>{{0, 0}, {49, 3}});
    REQUIRE(with("cloth.pinned", "[[0,0]]", scene).simulation.cloth.pinned == std::vector<sim::GridPoint>{{0, 0}});
    REQUIRE(with("cloth.pinned", "[]", scene) == scene::Scene{});
    scene = with("simulation.accelerations", "[[1,2,3],[0,0,-1]]");
    REQUIRE(scene.simulation.stepping.accelerations == std::vector<sim::Vec3>{{1, 2, 3}, {0, 0, -1}});
    REQUIRE(with("simulation.accelerations", "[]", scene) == scene::Scene{});
    require_refused("cloth.pinned", "[[0,0.5]]", {"cloth.pinned[0]", "two whole numbers"});
    require_refused("cloth.pinned", "3", {"cloth.pinned", "a list"});
    require_refused("cloth.pinned", "left", {"cloth.pinned", "a list", "a text"});
    require_refused("simulation.accelerations", "[[1,2]]", {"simulation.accelerations[0]", "three numbers"});
}

TEST_CASE("A pin outside the grid is found when all parameters are set, whatever their order") {
    scene::Scene scene = with("cloth.pinned", "[[60,0]]");
    REQUIRE_THROWS_AS(scene::check(scene, "two.json"), scene::SceneError);
    scene = with("cloth.num_width_points", "61", scene);
    REQUIRE_NOTHROW(scene::check(scene, "two.json"));
    try {
        scene::check(with("cloth.num_width_points", "60", scene), "two.json");
        FAIL("not found");
    } catch (const scene::SceneError& e) {
        REQUIRE(std::string(e.what()).find("two.json: cloth.pinned[0]: [60, 0] is outside the grid") == 0);
    }
}

TEST_CASE("Colliders are set by kind, the first of it, and by number") {
    const auto set = [](std::string_view key, std::string_view value) {
        return with(key, value, collision_scene()).simulation.colliders;
    };
    auto expected = collision_scene().simulation.colliders;
    std::get<sim::Sphere>(expected[0]).radius = 0.75;
    REQUIRE(set("sphere.radius", "0.75") == expected);
    REQUIRE(set("colliders.0.radius", "0.75") == expected);
    expected = collision_scene().simulation.colliders;
    std::get<sim::Plane>(expected[1]).normal = {1, 1, 0};
    REQUIRE(set("plane.normal", "1,1,0") == expected);
    REQUIRE(set("colliders.1.normal", "[1,1,0]") == expected);
    expected = collision_scene().simulation.colliders;
    std::get<sim::Sphere>(expected[2]).friction = 1;
    REQUIRE(set("colliders.2.friction", "1") == expected);
}

TEST_CASE("A collider is taken away with none, and those behind it move up") {
    const auto all = collision_scene().simulation.colliders;
    const scene::Scene without = with("colliders.1", "none", collision_scene());
    REQUIRE(without.simulation.colliders == std::vector<sim::Collider>{all[0], all[2]});
    REQUIRE(with("colliders.1", "none", without).simulation.colliders == std::vector<sim::Collider>{all[0]});
    for (const char* key : {"colliders.3", "colliders.x", "colliders.", "colliders.0x", "colliders"})
        require_refused(key, "none", {key});
}

TEST_CASE("A collider that is not there, and a member it has not, are refused") {
    require_refused("sphere.radius", "1", {"no sphere"}, {});
    require_refused("plane.friction", "1", {"no plane"}, {});
    require_refused("colliders.3.radius", "1", {"3 colliders"});
    for (const char* key : {"colliders.-1.radius", "colliders.x.radius", "colliders.0", "colliders..radius",
                            "colliders.99999999999999999999.radius", "colliders.0x.radius"})
        require_refused(key, "1", {key, "colliders.0.radius"});
    require_refused("sphere.radios", "1", {"sphere.radios", "did you mean \"radius\"?"});
    require_refused("plane.radius", "1", {"plane.radius", "unknown key", "normal"});
    require_refused("colliders.0.type", "plane", {"unknown key", "origin"});
    require_refused("sphere.radius", "0", {"sphere.radius", "above 0"});
    require_refused("colliders.1.friction", "1.5", {"colliders.1.friction", "from 0"});
    require_refused("plane.normal", "0,0,0", {"plane.normal", "zero vector"});
}

TEST_CASE("An unknown key is refused with the one that was meant") {
    require_refused("cloth.ksi", "1", {"unknown", "did you mean cloth.ks?", "clothlab list parameters"});
    require_refused("cloth.desnity", "1", {"did you mean cloth.density?"});
    require_refused("simulation.substep", "1", {"did you mean simulation.substeps?"});
    for (const char* key : {"", ".", "cloth", "cloth.", "completely.different", "rules.", "0"})
        require_refused(key, "1", {"unknown parameter"});
}

TEST_CASE("A bad value is refused with the argument, and with what is allowed") {
    require_refused("cloth.ks", "-1", {"cloth.ks: -1 is not allowed", "at least 0"});
    require_refused("cloth.ks", "", {"no value"});
    for (const char* value : {"stiff", "nan", "NaN", "inf", "1e999", "0x10", "5 N/m", "[5]", "{}", "true", "null"})
        require_refused("cloth.ks", value, {"cloth.ks", "a number"});
    require_refused("cloth.num_width_points", "1", {"from 2 to 2048"});
    require_refused("cloth.num_width_points", "1000000000", {"from 2 to 2048"});
    require_refused("cloth.enable_bending", "1", {"true or false"});
    require_refused("wind.kind", "storm", {"\"storm\" is not allowed", "\"course\""});
    require_refused("simulation.gravity", "1,2", {"three numbers"});
    require_refused("simulation.gravity", "1,2,x", {"not valid JSON"});
    require_refused("simulation.gravity", "9.8", {"three numbers"});
    require_refused("simulation.substeps", "1.5", {"a whole number"});
}

TEST_CASE("Name and description take any text as it is") {
    for (const char* text : {"one, two", "[1", "{\"a\": 1}", "\"quoted\"", "true", "a=b", "ä 🧵"}) {
        REQUIRE(with("name", text).name == text);
        REQUIRE(with("description", text).description == text);
    }
}

TEST_CASE("The nearest word is one that differs in a letter in three, or has two swapped, else there is none") {
    const std::vector<std::string_view> words{"width", "height", "ks", "density"};
    REQUIRE(scene::nearest("widht", words) == "width");
    REQUIRE(scene::nearest("hieght", words) == "height");
    REQUIRE(scene::nearest("ksi", words) == "ks");
    REQUIRE(scene::nearest("k", words) == "ks");
    REQUIRE(scene::nearest("dens", words) == std::nullopt);
    REQUIRE(scene::nearest("densities", words) == "density");
    REQUIRE(scene::nearest("width", words) == "width");
    REQUIRE(scene::nearest("", words) == std::nullopt);
    REQUIRE(scene::nearest("orientation", words) == std::nullopt);
    REQUIRE(scene::nearest("width", {}) == std::nullopt);
}

TEST_CASE("The table's defaults are allowed, its sliders' ends too, and its keys are unique") {
    const scene::Scene standard;
    for (const scene::Field& f : scene::fields()) {
        INFO(f.key);
        REQUIRE(scene::find_field(f.key) == &f);
        REQUIRE(std::string(f.section()) + "." + std::string(f.name()) == f.key);
        REQUIRE_FALSE(f.help.empty());
        REQUIRE_FALSE(f.label.empty());
        REQUIRE_FALSE(scene::allowed_values(f).empty());
        if (f.get)
            REQUIRE_FALSE(scene::objection(f, f.get(standard)));
        if (f.type == scene::FieldType::number || f.type == scene::FieldType::integer) {
            REQUIRE_FALSE(scene::objection(f, f.shown.max / f.shown.factor));
            REQUIRE((f.shown.min < f.shown.max && (f.shown.scale == scene::Scale::linear || f.shown.min > 0)));
            for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL})
                REQUIRE(scene::objection(f, bad));
        }
    }
    REQUIRE(scene::find_field("cloth.pinned") == nullptr);
}
