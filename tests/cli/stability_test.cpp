// clothlab experiment stability, as a program.
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <nlohmann/json.hpp>

#include "experiments/table.h"
#include "support/files.h"
#include "support/program.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::ContainsSubstring;
using nlohmann::ordered_json;

TEST_CASE("experiment stability --bisect finds the chain's limit and says how far off the prediction is", "[program]") {
    const Finished run =
        test::clothlab({"experiment", "stability", "chain", "--bisect", "ks", "--frames", "20", "--json"});
    REQUIRE(run.status == 0);
    const ordered_json json = ordered_json::parse(run.out);
    bool found = false;
    for (const ordered_json& row : json["rows"])
        if (row["distance_percent"].is_number()) {
            found = true;
            REQUIRE(std::abs(row["distance_percent"].get<double>()) < 0.1);
        }
    REQUIRE(found);
    REQUIRE_THAT(json["sentences"][0].get<std::string>(), ContainsSubstring("predicted 92846"));
}

TEST_CASE("experiment stability maps a scene and writes a row for each run", "[program]") {
    const Finished run = test::clothlab({"experiment", "stability", "chain", "-x", "density=1:4:3", "-y",
                                         "ks=1e4:1e6:6log", "--frames", "5", "--threads", "2", "--csv", "-"});
    REQUIRE(run.status == 0);
    const experiments::Table table = experiments::from_csv(run.out);
    REQUIRE(table.rows.size() > 6);
    REQUIRE(table.text(0, "verdict") == "stable");
    REQUIRE(table.text(table.rows.size() - 1, "verdict") != "stable");
}

TEST_CASE("experiment stability refuses what has no meaning, with status 2", "[program]") {
    const auto refused = [](std::vector<std::string> arguments, const char* why) {
        arguments.insert(arguments.begin(), {"experiment", "stability", "chain", "--frames", "2"});
        const Finished run = test::clothlab(arguments);
        INFO(run.err);
        REQUIRE(run.status == 2);
        REQUIRE_THAT(run.err, ContainsSubstring(why));
    };
    refused({"-x", "cloth.kss=1:2"}, "cloth.kss: there is no such parameter");
    refused({"-x", "ks=1:2", "-y", "cloth.ks=1:2"}, "have to differ");
    refused({"--from", "1"}, "--bisect");
    refused({"--bisect", "ks", "--from", "10", "--to", "20"}, "both ends");
    refused({"--bisect", "ks", "--from", "20", "--to", "10"}, "below");
    refused({"--bisect", "ks", "-x", "ks=1:2"}, "excludes");
    refused({"-y", "ks=-2:2"}, "ks");
}
