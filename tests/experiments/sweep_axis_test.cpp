// What --vary means: ranges, lists, and what is wrong with them.
#include <catch2/catch_test_macros.hpp>

#include "experiments/sweep/axis.h"
#include "scene/error.h"

using namespace clothlab;
using experiments::parse_axis;
using experiments::SweepAxis;
using Values = std::vector<std::string>;

namespace {

std::string error_of(const std::string& text) {
    try {
        parse_axis(text);
    } catch (const scene::SceneError& e) {
        return e.what();
    }
    return "";
}

} // namespace

TEST_CASE("A range is evenly spread, has both its ends, and reads as people write it") {
    const SweepAxis axis = parse_axis("cloth.damping=0:1:11");
    REQUIRE(axis.key == "cloth.damping");
    REQUIRE(axis.numeric);
    REQUIRE_FALSE(axis.log);
    REQUIRE(axis.values == Values{"0", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9", "1"});
    REQUIRE(axis.number(3) == 0.3);
    REQUIRE(parse_axis("cloth.ks=10:4:4").values == Values{"10", "8", "6", "4"});
    REQUIRE(parse_axis("cloth.offset_y=-1:1:3").values == Values{"-1", "0", "1"});
}

TEST_CASE("A range by factors has the same factor from each value to the next") {
    const SweepAxis axis = parse_axis("cloth.ks=1e2:1e5:7log");
    REQUIRE(axis.log);
    REQUIRE(axis.values.size() == 7);
    REQUIRE(axis.number(0) == 100);
    REQUIRE(axis.number(2) == 1000);
    REQUIRE(axis.number(4) == 10000);
    REQUIRE(axis.values[6] == "100000");
    for (std::size_t i = 1; i < 7; ++i)
        REQUIRE(std::abs(axis.number(i) / axis.number(i - 1) / std::sqrt(10.0) - 1) < 1e-11);
}

TEST_CASE("The ends of a range are what was written, to the last bit") {
    const SweepAxis axis = parse_axis("cloth.ks=0.12345678901234567:7.7777777777777777:3");
    REQUIRE(axis.number(0) == 0.12345678901234567);
    REQUIRE(axis.number(2) == 7.7777777777777777);
}

TEST_CASE("A range of a parameter that takes whole numbers has whole numbers, each once") {
    REQUIRE(parse_axis("simulation.substeps=5:100:4log").values == Values{"5", "14", "37", "100"});
    REQUIRE(error_of("simulation.substeps=1:10:8log") ==
            "--vary simulation.substeps=1:10:8log: only 7 of the 8 values are different, as this parameter takes whole "
            "numbers; ask for fewer, or list them");
    REQUIRE(error_of("cloth.ks=5:5:3").find("only 1 of the 3 values are different; ask for fewer") !=
            std::string::npos);
}

TEST_CASE("A list has names, numbers, and values with commas of their own") {
    const SweepAxis names = parse_axis("simulation.integrator=course-verlet,rk4");
    REQUIRE(names.values == Values{"course-verlet", "rk4"});
    REQUIRE_FALSE(names.numeric);
    const SweepAxis numbers = parse_axis("cloth.ks=1e3,+20,-0.50");
    REQUIRE(numbers.values == Values{"1000", "20", "-0.5"});
    REQUIRE(numbers.numeric);
    REQUIRE(parse_axis("simulation.gravity=[0,-9.8,0],[0,-1.62,0]").values == Values{"[0,-9.8,0]", "[0,-1.62,0]"});
    REQUIRE(parse_axis("cloth.pinned=[[0,0]],[[0,0],[0,49]]").values == Values{"[[0,0]]", "[[0,0],[0,49]]"});
    REQUIRE(parse_axis("look.shader=7,mirror").values == Values{"7", "mirror"});
    REQUIRE_FALSE(parse_axis("look.shader=7,8").numeric); // a shader's name is text, whatever it looks like
    REQUIRE(parse_axis("cloth.enable_bending=true,false").values == Values{"true", "false"});
    REQUIRE(parse_axis("cloth.ks=500").values == Values{"500"});
}

TEST_CASE("A list of positive numbers over two decades or more is spread by factors") {
    REQUIRE(parse_axis("cloth.ks=1,10,100").log);
    REQUIRE_FALSE(parse_axis("cloth.ks=1,10,99").log);
    REQUIRE_FALSE(parse_axis("cloth.ks=0,10,1000").log);
}

TEST_CASE("What is wrong with --vary is said with its place") {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"cloth.ks", "write KEY=FIRST:LAST:COUNT"},
        {"=1,2", "write KEY=FIRST:LAST:COUNT"},
        {"cloth.ks=", "write KEY=FIRST:LAST:COUNT"},
        {"cloth.ks=1:2", "a range is FIRST:LAST:COUNT"},
        {"cloth.ks=1:2:3:4", "a range is FIRST:LAST:COUNT"},
        {"cloth.ks=1:b:3", "'b' is not a number"},
        {"cloth.ks=1:nan:3", "'nan' is not a number"},
        {"cloth.ks=1:2:1", "'1' is not how many values there are to be"},
        {"cloth.ks=1:2:2.5", "'2.5' is not how many values there are to be"},
        {"cloth.ks=1:2:-3", "'-3' is not how many values there are to be"},
        {"cloth.ks=1:2:1e9", "'1e9' is not how many values there are to be"},
        {"cloth.ks=1:2:log", "'log' is not how many values there are to be"},
        {"cloth.ks=0:2:3log", "a range by factors has two positive ends"},
        {"cloth.ks=1,,2", "a value is missing"},
        {"cloth.ks=1,2,", "a value is missing"},
        {"cloth.ks=5,5.0", "has 5 twice"},
        {"look.shader=a\nb", "cannot have line breaks"},
    };
    for (const auto& [text, message] : cases) {
        INFO(text);
        const std::string error = error_of(text);
        REQUIRE(error.find("--vary " + text + ": ") == 0);
        REQUIRE(error.find(message) != std::string::npos);
    }
}
