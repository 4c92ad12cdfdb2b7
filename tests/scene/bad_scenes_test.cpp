// Every way to get a scene wrong ends in a sentence with its place, what is wrong and what is allowed.
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
#include <vector>

#include "scene/io.h"
#include "support/files.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

/// What reading says; empty when it succeeds.
std::string error_of(const std::string& text) {
    try {
        scene::read_scene(text, "bad.json");
    } catch (const scene::SceneError& e) {
        return e.what();
    }
    return "";
}

/// Expects an error with all of these parts.
void require_error(const std::string& text, const std::vector<std::string>& parts) {
    const std::string error = error_of(text);
    INFO(text.substr(0, 1000));
    INFO(error);
    REQUIRE_FALSE(error.empty());
    for (const std::string& part : parts) {
        INFO("expected: " << part);
        REQUIRE(error.find(part) != std::string::npos);
    }
}

/// The course's pinned cloth with a passage replaced; the file has one key per line.
std::string course(const std::string& from, const std::string& to) {
    std::string text = read_file(checkout() / "tests/data/cs184-pinned2.json");
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

std::string own(const std::string& rest) {
    return "{\"clothlab\": 1,\n" + rest + "}";
}

} // namespace

TEST_CASE("A key that is missing is named, with what it must be") {
    require_error(course("    \"ks\": 5000.0,\n", ""), {"bad.json:2:", "cloth.ks", "missing", "at least 0", "N/m"});
    require_error(course("\"enable_bending\": true,", ""), {"bad.json:2:", "cloth.enable_bending", "true or false"});
    require_error("{}", {"bad.json:1:", "cloth", "missing"});
    require_error(R"({"cloth": {}})", {"cloth.width", "missing", "a number above 0, in m"});
    require_error(own("\"sphere\": {\"origin\": [0, 0, 0]}"), {"bad.json:2:", "sphere.radius", "missing"});
    require_error(own("\"plane\": {\"point\": [0, 0, 0]}"), {"bad.json:2:", "plane.normal", "missing"});
    require_error(own("\"colliders\": [\n{\"radius\": 1}]"), {"bad.json:3:", "colliders[0].type", "\"sphere\""});
    // The course's simulator needs the friction that our own format leaves out.
    require_error(course("{\n  \"cloth\"", "{ \"sphere\": {\"origin\": [0, 0, 0], \"radius\": 1},\n  \"cloth\""),
                  {"bad.json:1:", "sphere.friction", "missing"});
}

TEST_CASE("A value of the wrong type is named with its line, what it is and what it must be") {
    require_error(course("\"ks\": 5000.0", "\"ks\": \"stiff\""),
                  {"bad.json:5: cloth.ks", "a number", "this is a text"});
    require_error(course("\"enable_structural\": true", "\"enable_structural\": 1"),
                  {"bad.json:6: cloth.enable_structural", "true or false", "this is a number"});
    require_error(course("\"width\": 1", "\"width\": null"), {"bad.json:10: cloth.width", "a number", "this is null"});
    require_error(own("\"cloth\": []"), {"bad.json:2: cloth", "an object", "this is a list"});
    require_error(own("\"name\": 7"), {"bad.json:2: name", "a text", "this is a number"});
    require_error(own("\"simulation\": {\"gravity\": 9.8}"), {"bad.json:2: simulation.gravity", "three numbers"});
    require_error(own("\"simulation\": {\"gravity\": [0, 1]}"),
                  {"bad.json:2: simulation.gravity", "three numbers", "a list of 2"});
    require_error(own("\"simulation\": {\"gravity\":\n[0, 1, \"2\"]}"), {"simulation.gravity[2]", "this is a text"});
    require_error(own("\"look\": {\"shader\": 3}"), {"look.shader", "a text"});
    require_error(own("\"colliders\": {}"), {"colliders", "a list", "this is an object"});
    require_error(own("\"colliders\": [7]"), {"colliders[0]", "an object", "this is a number"});
    require_error(own("\"colliders\": [{\"type\": \"cone\"}]"), {"colliders[0].type", "\"sphere\" or \"plane\""});
    require_error(own("\"wind\": {\"kind\": 2}"), {"wind.kind", "\"course\"", "this is a number"});
    require_error(own("\"wind\": {\"kind\": \"storm\"}"), {"wind.kind", "\"storm\" is not allowed", "\"physical\""});
    require_error("[]", {"bad.json:1:", "one JSON object", "this is a list"});
    require_error("\n\n7", {"bad.json:3:", "one JSON object", "this is a number"});
}

TEST_CASE("An unknown key is an error that names the one that was meant, and those allowed") {
    require_error(course("\"ks\"", "\"ksi\""), {"bad.json:5: cloth.ksi", "unknown", "did you mean \"ks\"?", "density"});
    require_error(own("\"cloth\": {\n\"widht\": 1}"), {"bad.json:3: cloth.widht", "did you mean \"width\"?"});
    require_error(own("\"simulation\": {\n\n\"substep\": 1}"), {"bad.json:4:", "did you mean \"substeps\"?"});
    require_error(own("\"colour\": 1"), {"bad.json:2: colour", "unknown key", "allowed are", "colliders"});
    require_error(own("\"sphere\": {\"origin\": [0,0,0], \"radius\": 1, \"radios\": 2}"),
                  {"sphere.radios", "did you mean \"radius\"?"});
    require_error(own("\"sphere\": {\"type\": \"cone\", \"origin\": [0,0,0], \"radius\": 1}"),
                  {"sphere.type", "unknown"});
    const std::string foreign = error_of(course("{\n  \"cloth\"", "{\n  \"name\": \"mine\",\n  \"cloth\""));
    REQUIRE(foreign.find("bad.json:2: name: unknown key") == 0);
    REQUIRE(foreign.find("\"clothlab\": 1") != std::string::npos); // how to say that it is ours
}

TEST_CASE("A key that stands twice is an error at its second place") {
    require_error(course("\"ks\": 5000.0,", "\"ks\": 5000.0,\n\"ks\": 5000.0,"), {"bad.json:6:", "\"ks\"", "twice"});
    require_error(own("\"name\": \"a\",\n\"name\": \"a\""), {"bad.json:3:", "\"name\"", "twice"});
}

TEST_CASE("A pin outside the grid is named with its line and the columns and rows there are") {
    const std::string list = "[0, 0], [49, 0]";
    require_error(course(list, "[0, 0],\n[50, 0]"),
                  {"bad.json:17:", "cloth.pinned[1]", "[50, 0]", "outside", "0 to 49"});
    require_error(course(list, "[0, 0],\n\n[0, 50], [0, 0]"), {"bad.json:18:", "cloth.pinned[1]"});
    require_error(course(list, "[-1, 0]"), {"bad.json:16:", "cloth.pinned[0]", "outside"});
    require_error(course(list, "[]"), {"bad.json:16:", "cloth.pinned[0]", "two whole numbers"});
    require_error(course(list, "[1]"), {"cloth.pinned[0]", "[column, row]"});
    require_error(course(list, "[1, 2, 3]"), {"cloth.pinned[0]", "[column, row]"});
    require_error(course(list, "[0, 1.5]"), {"bad.json:16:", "cloth.pinned[0]", "two whole numbers"});
    require_error(course(list, "[0, 1e12]"), {"cloth.pinned[0]", "two whole numbers"});
    require_error(course(list, "[0, true]"), {"cloth.pinned[0]", "a number"});
    require_error(course(list, "4"), {"cloth.pinned[0]", "two whole numbers"});
    require_error(course("[\n      " + list + "\n    ]", "0"), {"bad.json:15:", "cloth.pinned", "a list"});
    // The grid may come after the pins.
    require_error(own("\"cloth\": {\"pinned\": [[3, 3]],\n\"num_width_points\": 3}"),
                  {"bad.json:2:", "columns are 0 to 2"});
}

TEST_CASE("Grids of one point, of half points and of a thousand million are refused") {
    const std::string width = "\"num_width_points\": 50", key = "bad.json:12: cloth.num_width_points: ";
    require_error(course(width, "\"num_width_points\": 1"), {key + "1 is not allowed", "from 2 to 2048"});
    require_error(course(width, "\"num_width_points\": 0"), {key + "0 is not allowed"});
    require_error(course(width, "\"num_width_points\": -5"), {key + "-5 is not allowed"});
    require_error(course(width, "\"num_width_points\": 2.5"), {key + "2.5 is not allowed", "a whole number"});
    require_error(course(width, "\"num_width_points\": 1000000000"), {key + "1000000000 is not allowed", "2048"});
    require_error(course(width, "\"num_width_points\": 99999999999999999999999"), {key, "a whole number"});
}

TEST_CASE("Values without a meaning are refused, with those that have one") {
    require_error(own("\"sphere\": {\"origin\": [0,0,0],\n\"radius\": 0}"), {"bad.json:3: sphere.radius", "above 0"});
    require_error(own("\"sphere\": {\"origin\": [0,0,0],\n\"radius\": -1}"), {"bad.json:3: sphere.radius", "above 0"});
    for (const char* friction : {"-0.1", "1.0000001", "7"}) {
        require_error(
            own(std::string("\"sphere\": {\"origin\": [0,0,0], \"radius\": 1,\n\"friction\": ") + friction + "}"),
            {"bad.json:3: sphere.friction", "from 0", "to 1"});
        require_error(own(std::string("\"colliders\": [{\"type\": \"plane\", \"point\": [0,0,0], \"normal\": [0,1,0],\n"
                                      "\"friction\": ") +
                          friction + "}]"),
                      {"bad.json:3: colliders[0].friction", "from 0", "to 1"});
    }
    require_error(own("\"plane\": {\"point\": [0,0,0],\n\"normal\": [0,-0.0,0]}"),
                  {"bad.json:3: plane.normal", "zero vector"});
    require_error(course("\"density\": 150.0", "\"density\": 0"), {"bad.json:4: cloth.density", "other than 0"});
    require_error(course("\"damping\": 0.2", "\"damping\": 100.5"), {"bad.json:3: cloth.damping", "from 0 to 100"});
    require_error(course("\"orientation\": 0", "\"orientation\": 2"),
                  {"bad.json:9: cloth.orientation", "1 (vertical)"});
    require_error(course("\"orientation\": 0", "\"orientation\": 0.5"), {"bad.json:9: cloth.orientation"});
    require_error(course("\"ks\": 5000.0", "\"ks\": -1"), {"bad.json:5: cloth.ks: -1 is not allowed", "at least 0"});
    require_error(course("\"width\": 1", "\"width\": 0"), {"bad.json:10: cloth.width", "above 0"});
    for (const char* substeps : {"0", "-1", "1.5", "1e9"})
        require_error(own(std::string("\"simulation\": {\"substeps\": ") + substeps + "}"),
                      {"bad.json:2: simulation.substeps", "a whole number from 1 to 100000"});
    for (const char* seed : {"-1", "0.5", "9007199254740992", "9007199254740993", "18446744073709551617", "1e300"})
        require_error(own(std::string("\"simulation\": {\"seed\": ") + seed + "}"),
                      {"bad.json:2: simulation.seed", "a whole number from 0 to 9007199254740991"});
    REQUIRE(scene::read_scene(own("\"simulation\": {\"seed\": 9007199254740991}"), "text").simulation.stepping.seed ==
            9007199254740991.0);
}

TEST_CASE("Another version of the format is refused, with the one that can be read") {
    for (const char* version : {"2", "0", "1.5", "\"1\"", "null", "true", "[1]"})
        require_error(std::string("{\n\"clothlab\": ") + version + "}", {"bad.json:2: clothlab", "version 1"});
}

TEST_CASE("Text that is not JSON is refused with its line") {
    const std::string ks = "\"ks\": 5000.0";
    for (const char* literal :
         {"NaN", "nan", "Infinity", "-Infinity", "inf", "0x10", "1.", ".5", "+1", "1,5 kN", "'5'"})
        require_error(course(ks, std::string("\"ks\": ") + literal), {"bad.json:5:", "not valid JSON"});
    for (const char* number : {"1e999", "-1e999"})
        require_error(course(ks, std::string("\"ks\": ") + number), {"bad.json:5:", "no double can hold", number});
    require_error(course(ks + ",", "\"ks\": 1e999\n"), {"bad.json:5:", "no double can hold"});
    require_error(course(ks + ",", ks), {"bad.json:6:", "not valid JSON"}); // a comma is missing
    require_error(course("\"pinned\": [", "// corners\n\"pinned\": ["), {"bad.json:15:", "not valid JSON"});
    const std::string text = course("", "");
    for (const char* garbage : {"x", "}", "{}", "1", "\n\n,"})
        require_error(text + garbage, {"bad.json:2", "not valid JSON at"});
    REQUIRE(error_of(own("") + "x").find("too early") == std::string::npos); // it is not too short but too long
    require_error(text.substr(0, text.size() - 3), {"bad.json:18:", "too early"});
    require_error("{\"clothlab\": 1, \"name\": \"a\xff\"}", {"bad.json:1:", "not valid JSON"});
}

TEST_CASE("A number at the end of its line belongs to that line") {
    require_error("{\"clothlab\": 1, \"cloth\": {\"pinned\": [[0,\n0],\n[\n777,\n0\n]]}}", {"bad.json:3:", "[777, 0]"});
    require_error("{\"clothlab\": 1,\n\"simulation\": {\"gravity\": [\n0,\n0,\n\"x\"\n]}}",
                  {"bad.json:5:", "gravity[2]"});
    require_error("{\"clothlab\": 1, \"cloth\": {\"pinned\": [\n5\n,\n[0, 0]]}}", {"bad.json:2:", "cloth.pinned[0]"});
    require_error("\r\n\r\n7\r\n", {"bad.json:3:", "one JSON object"});
}

TEST_CASE("Empty text is called empty") {
    for (const char* text : {"", " ", "\n\n\t \r\n"})
        require_error(text, {"bad.json", "empty", "cloth"});
    require_error("\xef\xbb\xbf", {"bad.json"});
}

TEST_CASE("A folder, a missing file, an empty file and an endless one are refused by name") {
    const TemporaryFolder folder;
    write_file(folder / "empty.json", "");
    const auto error_of_file = [](const std::filesystem::path& file) -> std::string {
        try {
            scene::load_scene(file);
        } catch (const scene::SceneError& e) {
            REQUIRE(std::string(e.what()).find(file.string() + ": ") == 0);
            return e.what();
        }
        return "";
    };
    CHECK(error_of_file(folder.path()).find("folder") != std::string::npos);
    CHECK(error_of_file(folder / "missing.json").find("No such file") != std::string::npos);
    CHECK(error_of_file(folder / "empty.json").find("empty") != std::string::npos);
    CHECK(error_of_file("/dev/zero").find("too large") != std::string::npos);
}
