// clothlab experiment accuracy, as a program.
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
#include <nlohmann/json.hpp>

#include "experiments/table.h"
#include "support/files.h"
#include "support/program.h"

using namespace clothlab::test;
using nlohmann::json;

namespace {

/// A small piece of the shipped scene, quickly measured.
std::vector<std::string> accuracy(const std::vector<std::string>& rest) {
    std::vector<std::string> all{"experiment",
                                 "accuracy",
                                 "smooth",
                                 "--set",
                                 "cloth.num_width_points=4",
                                 "--set",
                                 "cloth.num_height_points=4",
                                 "--set",
                                 "cloth.pinned=[[0,3],[3,3]]",
                                 "--seconds",
                                 "0.1",
                                 "--rounds",
                                 "1",
                                 "--threads",
                                 "1"};
    all.insert(all.end(), rest.begin(), rest.end());
    return all;
}

} // namespace

TEST_CASE("experiment accuracy prints one JSON object and writes its table", "[program]") {
    const TemporaryFolder folder;
    const std::string file = (folder / "table.csv").string();
    const Finished finished = clothlab::test::clothlab(accuracy(
        {"--methods", "rk4,velocity-verlet", "--substeps", "1:16:3", "--quantity", "sag", "--csv", file, "--json"}));
    INFO(finished.err);
    REQUIRE(finished.status == 0);
    const json object = json::parse(finished.out);
    REQUIRE(object["rows"].size() == 12); // two methods, three steps, two precisions
    REQUIRE(object["rows"][0]["cost_s_per_s"] > 0);
    REQUIRE(object["rows"][1]["substeps"] == 4);
    REQUIRE(object["sentences"][0].get<std::string>().find("mm sag") != std::string::npos);
    REQUIRE(object["reference"].size() > 2);
    const auto table = clothlab::experiments::from_csv(read_file(file));
    REQUIRE(table.rows.size() == 12);
    REQUIRE(table.number(1, "sag_error_mm") == object["rows"][1]["sag_error_mm"]);
}

TEST_CASE("What experiment accuracy cannot do ends with status 2 and a sentence", "[program]") {
    const auto require_failure = [](const std::vector<std::string>& rest, const std::string& part) {
        const Finished finished = clothlab::test::clothlab(accuracy(rest));
        INFO(finished.err);
        REQUIRE(finished.status == 2);
        REQUIRE(finished.out.empty());
        REQUIRE(finished.err.find(part) != std::string::npos);
    };
    require_failure({"--substeps", "4:1:3"}, "FROM");
    require_failure({"--substeps", "1,x"}, "whole numbers");
    require_failure({"--substeps", "0"}, "whole numbers");
    require_failure({"--methods", "leapfrog"}, "leapfrog");
    require_failure({"--set", "cloth.density=-1"}, "push");
}
