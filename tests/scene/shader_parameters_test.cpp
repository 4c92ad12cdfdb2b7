// What shader files declare of themselves, and the values that scenes give to it.
#include <catch2/catch_test_macros.hpp>

#include "scene/error.h"
#include "scene/io.h"
#include "scene/shader_parameters.h"

using namespace clothlab;
using scene::ShaderParameterType;

namespace {

constexpr const char* text = R"(#version 330 core
//@ shader title="Weave" help="A test." quantity="strain"
uniform float p = 32.5;   //@ label="Shininess p" min=1 max=1000 log unit="%" help="Sharp, or not."
  uniform int bands = 3; //@ min=1 max=8
uniform bool on = true; //@ label="On"
uniform vec3 tint; //@ label="Tint" colour="#FF8000"
uniform sampler2D map; //@ texture=ramp default="viridis"
uniform samplerCube sky; //@ default="room"
uniform float low = -1.0; //@ min=-5 max=0
uniform mat4 other;
//@ legend title="Strain" unit="%" low=low high=p map=map
uniform int bands = 3; //@ min=0 max=9
)";

/// The message of a declaration that is wrong, and its line.
std::pair<std::string, int> error_of(const std::string& wrong) {
    try {
        scene::read_shader_declaration("x", "\n" + wrong + "\n");
    } catch (const scene::ShaderDeclarationError& e) {
        return {e.what(), e.line()};
    }
    return {};
}

bool contains(const std::string& whole, const std::string& part) {
    return whole.find(part) != std::string::npos;
}

std::string message_of(const scene::Look& look, const std::vector<scene::ShaderDeclaration>& shaders) {
    try {
        scene::check_shader_values(look, shaders, "a.json");
    } catch (const scene::SceneError& e) {
        return e.what();
    }
    return {};
}

} // namespace

TEST_CASE("A shader's sliders are read from the comments beside its uniforms", "[shaders]") {
    const scene::ShaderDeclaration shader = scene::read_shader_declaration("weave", text);
    CHECK(shader.title == "Weave");
    CHECK(shader.help == "A test.");
    CHECK(shader.quantity == "strain");
    CHECK_FALSE(shader.lines);
    REQUIRE(shader.parameters.size() == 7);
    const scene::ShaderParameter& p = *shader.find("p");
    CHECK((p.label == "Shininess p" && p.help == "Sharp, or not." && p.unit == "%" && p.logarithmic));
    CHECK((p.min == 1 && p.max == 1000 && std::get<double>(p.value) == 32.5));
    CHECK(shader.find("bands")->type == ShaderParameterType::integer);
    CHECK(shader.find("bands")->min == 1); // the first declaration counts
    CHECK(shader.find("bands")->label == "bands");
    CHECK(std::get<bool>(shader.find("on")->value));
    CHECK(std::get<sim::Vec3>(shader.find("tint")->value) == sim::Vec3{1, 128 / 255.0, 0});
    CHECK(shader.find("map")->usage == scene::TextureUsage::ramp);
    CHECK(shader.find("sky")->usage == scene::TextureUsage::environment);
    CHECK(std::get<std::string>(shader.find("sky")->value) == "room");
    REQUIRE(shader.legend);
    CHECK((shader.legend->title == "Strain" && shader.legend->low == "low" && shader.legend->map == "map"));
    CHECK(shader.find("other") == nullptr);
    CHECK(scene::read_shader_declaration("plain", "void main() {}").title == "plain");
}

TEST_CASE("A declaration that is wrong is refused with its line", "[shaders]") {
    const std::pair<const char*, const char*> wrong[] = {
        {"uniform float p; //@ min=0 max=1", "initial value of p"},
        {"uniform float p = 1.0; //@ min=2 max=1", "min below max"},
        {"uniform float p = 1.0; //@ min=0 max=1 log", "above 0"},
        {"uniform float p = 1.0; //@ minimum=0", "\"minimum\" means nothing"},
        {"uniform float p = 1.0; //@ min=zero", "must be a number"},
        {"uniform float p = 1.0; //@ help=\"open", "key=value"},
        {"uniform bool p = 1; //@ label=\"P\"", "true or false"},
        {"uniform vec3 p = vec3(1.0); //@ label=\"P\"", "colour=\"#RRGGBB\""},
        {"uniform vec3 p; //@ colour=\"#12345G\"", "colour=\"#RRGGBB\""},
        {"uniform sampler2D p; //@ texture=sound", "colour, height or ramp"},
        {"uniform mat4 p; //@ label=\"P\"", "cannot be a parameter"},
        {"in float p; //@ label=\"P\"", "belongs behind a uniform"},
        {"//@ shadow title=\"P\"", "starts with \"shader\""},
        {"//@ shader quantity=\"mood\"", "no such quantity"},
        {"//@ legend title=\"P\" low=a high=b map=c", "must name parameters"},
    };
    for (const auto& [line, what] : wrong) {
        INFO(line);
        const auto [message, number] = error_of(line);
        CHECK(contains(message, what));
        CHECK(number == 2);
    }
}

TEST_CASE("A look's values replace a shader's defaults, and a default is not kept", "[shaders]") {
    const scene::ShaderDeclaration shader = scene::read_shader_declaration("weave", text);
    const scene::ShaderParameter &p = *shader.find("p"), &tint = *shader.find("tint");
    scene::Look look;
    CHECK(number_of(look, shader, "p") == 32.5);
    scene::set_value(look, shader, p, 2000.0); // typing goes beyond the slider
    CHECK(number_of(look, shader, "p") == 2000);
    look.shaders["weave"]["tint"] = "#000000";
    CHECK(std::get<sim::Vec3>(scene::value_of(look, shader, tint)) == sim::Vec3{0, 0, 0});
    look.shaders["weave"]["tint"] = true; // no colour
    CHECK(scene::value_of(look, shader, tint) == tint.value);
    scene::set_value(look, shader, tint, tint.value);
    scene::set_value(look, shader, p, 32.5);
    CHECK(look == scene::Look{});
}

TEST_CASE("Values that no parameter has, or of the wrong type, are told with what is there", "[shaders]") {
    const std::vector<scene::ShaderDeclaration> shaders = {scene::read_shader_declaration("weave", text)};
    scene::Look look;
    look.shaders["unknown"]["x"] = 1.0; // of somebody who has more shaders
    CHECK(message_of(look, shaders).empty());
    look.shaders["weave"]["band"] = 1.0;
    CHECK(contains(message_of(look, shaders), "a.json: look.shaders.weave.band"));
    CHECK(contains(message_of(look, shaders), "did you mean \"bands\"?"));
    const std::pair<const char*, scene::ShaderValue> wrong[] = {
        {"p", true}, {"bands", 1.5}, {"on", 1.0}, {"tint", sim::Vec3{2, 0, 0}}, {"tint", "red"}, {"map", 3.0}};
    for (const auto& [name, value] : wrong) {
        look.shaders["weave"] = {{name, value}};
        INFO(name);
        CHECK(contains(message_of(look, shaders), "it must be "));
    }
    look.shaders["weave"] = {{"p", 1.0}, {"bands", 2.0}, {"on", false}, {"tint", "#112233"}, {"map", "inferno"}};
    CHECK(message_of(look, shaders).empty());
}

TEST_CASE("Scenes and --set give shaders' parameters their values", "[shaders]") {
    const scene::Scene read = scene::read_scene(
        R"({"clothlab": 1, "look": {"shaders": {"a": {"n": 1.5, "b": false, "c": [0, 0.5, 1], "t": "x.png"}}}})", "s");
    const scene::ShaderValues expected = {
        {"n", 1.5}, {"b", false}, {"c", sim::Vec3{0, 0.5, 1}}, {"t", std::string("x.png")}};
    CHECK(read.look.shaders.at("a") == expected);
    scene::Scene set;
    for (const auto& [key, value] : {std::pair{"n", "1.5"}, {"b", "false"}, {"c", "0,0.5,1"}, {"t", "x.png"}})
        scene::set_parameter(set, std::string("look.shaders.a.") + key, value);
    CHECK(set.look.shaders == read.look.shaders);
    CHECK_THROWS_AS(scene::set_parameter(set, "look.shaders.a", "1"), scene::SceneError);
    CHECK_THROWS_AS(scene::set_parameter(set, "look.shaders.a.", "1"), scene::SceneError);
    for (const char* wrong : {R"({"a": 1})", R"({"a": {"n": null}})", R"({"a": {"n": [1, 2]}})", R"([])"})
        CHECK_THROWS_AS(scene::read_scene(R"({"clothlab": 1, "look": {"shaders": )" + std::string(wrong) + "}}", "s"),
                        scene::SceneError);
}
