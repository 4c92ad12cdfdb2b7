// `clothlab experiment needs` as a program.
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
#include <nlohmann/json.hpp>

#include "experiments/table.h"
#include "support/files.h"
#include "support/program.h"

using namespace clothlab;
using namespace clothlab::test;
using nlohmann::json;

namespace {

const std::string tiny = R"({"clothlab": 1, "name": "Tiny", "cloth": {"num_width_points": 6, "num_height_points": 6,
    "ks": 1000, "pinned": [[0, 0], [5, 0]]}, "simulation": {"substeps": 6}})";

/// The command on a tiny scene, with few methods' worth of work.
Finished needs(const std::string& scene, std::vector<std::string> more) {
    std::vector<std::string> arguments{"experiment", "needs", scene, "--seconds", "0.1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return clothlab::test::clothlab(arguments);
}

} // namespace

TEST_CASE("experiment needs ends in a table, a sentence and a preset that can be run", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = (folder / "tiny.json").string(), preset = (folder / "preset.json").string(),
                      csv = (folder / "table.csv").string();
    write_file(scene, tiny);
    const Finished finished =
        needs(scene, {"--tolerance", "2", "--keep", "simulation.integrator", "--save", preset, "--csv", csv, "--json"});
    INFO(finished.err);
    REQUIRE(finished.status == 0);
    const json found = json::parse(finished.out);
    REQUIRE(found["sentences"][0].get<std::string>().find("mm off (wanted 2 mm") != std::string::npos);
    const experiments::Table table = experiments::from_csv(read_file(csv));
    REQUIRE(table.rows.size() == found["rows"].size());
    REQUIRE(table.text(0, "stage") == "full model");
    bool proved = false;
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        proved = proved || (table.text(i, "model") == "no self-collision" && table.number(i, "deviation_mm") == 0 &&
                            table.text(i, "evidence").starts_with("proof"));
    REQUIRE(proved);
    REQUIRE(clothlab::test::clothlab({"validate", preset}).status == 0);
    REQUIRE(clothlab::test::clothlab({"run", preset, "--frames", "9", "--hash"}).status == 0);
}

TEST_CASE("experiment needs refuses what has no answer with status 2 and a sentence", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = (folder / "tiny.json").string();
    write_file(scene, tiny);
    const std::vector<std::pair<std::vector<std::string>, std::string>> wrong{
        {{"--quantity", "first-contact"}, "no first contact"},
        {{"--quantity", "beauty"}, "--quantity"},
        {{"--tolerance", "0"}, "--tolerance"},
        {{"--tolerance", "nan"}, "above zero"},
        {{"--tolerance", "1e-12"}, "chaotic"},
        {{"--keep", "cloth.kss"}, "did you mean cloth.ks"},
        {{"--save", (folder / "none" / "preset.json").string()}, "cannot be written"}};
    for (const auto& [arguments, part] : wrong) {
        const Finished finished = needs(scene, arguments);
        INFO(finished.err);
        REQUIRE(finished.status != 0);
        REQUIRE(finished.out.empty());
        REQUIRE(finished.err.find(part) != std::string::npos);
    }
}
