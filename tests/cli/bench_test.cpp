// clothlab bench, as a program.
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/program.h"

using namespace clothlab::test;
using nlohmann::json;

TEST_CASE("bench --json prints one object with the machine, the rows and a summary, and its progress elsewhere",
          "[program]") {
    const Finished finished = clothlab::test::clothlab({"bench", "--quick", "--sizes", "8", "--json"});
    INFO(finished.err);
    REQUIRE(finished.status == 0);
    REQUIRE(finished.err.find("falling 8 x 8") != std::string::npos);
    const json object = json::parse(finished.out);
    REQUIRE(object["machine"]["peaks"].size() >= 1);
    REQUIRE(object["machine"]["peaks"][0]["bandwidth_gb_per_s"]["L1"] > 0);
    REQUIRE(object["summary"].is_array());
    REQUIRE(object["rows"].size() >= 9); // three cases, each with the textbook and both precisions at least
    int textbooks = 0;
    for (const json& row : object["rows"]) {
        REQUIRE(row["n"] == 8);
        REQUIRE(row["points"] == 64);
        REQUIRE(row["step_us"]["median"] > 0);
        REQUIRE(row["speedup"] > 0);
        REQUIRE(row["stage_us"].size() == 5);
        textbooks += row["kernel"] == "textbook" ? 1 : 0;
    }
    REQUIRE(textbooks == 3);
}

TEST_CASE("bench prints a table that fits 120 columns", "[program]") {
    const Finished finished = clothlab::test::clothlab({"bench", "--quick", "--sizes", "8,9", "--threads", "1",
                                                        "--filter", "springs/./(single/scalar|double/textbook)"});
    INFO(finished.err);
    REQUIRE(finished.status == 0);
    std::istringstream lines(finished.out);
    int scalar = 0;
    for (std::string line; std::getline(lines, line);) {
        INFO(line);
        REQUIRE(line.size() <= 120);
        scalar += line.rfind("scalar", 0) == 0 ? 1 : 0;
    }
    REQUIRE(scalar == 2);
    REQUIRE(finished.out.find("ns per point") != std::string::npos);
}

TEST_CASE("What bench cannot do ends with status 2 and a sentence", "[program]") {
    const auto require_failure = [](const std::vector<std::string>& rest, const std::string& part) {
        std::vector<std::string> arguments{"bench", "--quick"};
        arguments.insert(arguments.end(), rest.begin(), rest.end());
        const Finished finished = clothlab::test::clothlab(arguments);
        INFO(finished.err);
        REQUIRE(finished.status == 2);
        REQUIRE(finished.out.empty());
        REQUIRE(finished.err.find(part) != std::string::npos);
    };
    require_failure({"--filter", "("}, "no regular expression");
    require_failure({"--filter", "velvet"}, "matches no run");
    require_failure({"--sizes", "1"}, "--sizes");
    require_failure({"--sizes", "50,x"}, "--sizes");
    require_failure({"--threads", "0"}, "--threads");
    require_failure({"falling"}, "falling");
}
