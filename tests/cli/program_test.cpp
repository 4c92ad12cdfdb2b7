// The program's manners: exit status, what goes to which stream, usage errors, validate and list.
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
#include <nlohmann/json.hpp>

#include "scene/fields.h"
#include "support/files.h"
#include "support/run.h"

using namespace clothlab;
using namespace clothlab::test;
using nlohmann::json;

namespace {

/// Expects a status, nothing on standard output, and these parts on standard error.
void require_failure(int status, const std::vector<std::string>& arguments, const std::vector<std::string>& parts) {
    const Finished finished = clothlab::test::clothlab(arguments);
    std::string line = "clothlab";
    for (const std::string& argument : arguments)
        line += " " + argument;
    INFO(line);
    INFO(finished.err);
    REQUIRE(finished.status == status);
    REQUIRE(finished.out.empty());
    REQUIRE(finished.err.size() > 20); // a sentence
    REQUIRE(finished.err.back() == '\n');
    for (const std::string& part : parts) {
        INFO(part);
        REQUIRE(finished.err.find(part) != std::string::npos);
    }
}

} // namespace

TEST_CASE("Usage errors end with status 2 and a sentence on standard error", "[program]") {
    require_failure(2, {"run"}, {"scene"});
    require_failure(2, {"run", pinned2, "--frame", "1"}, {"--frame"});
    require_failure(2, {"run", pinned2, "extra"}, {"extra"});
    require_failure(2, {"run", pinned2, "--frames", "-1"}, {"--frames"});
    require_failure(2, {"run", pinned2, "--frames", "1.5"}, {"--frames"});
    require_failure(2, {"run", pinned2, "--frames", "99999999999"}, {"--frames"});
    require_failure(2, {"run", pinned2, "--frames"}, {"--frames"});
    require_failure(2, {"run", pinned2, "--seconds", "-1"}, {"--seconds"});
    require_failure(2, {"run", pinned2, "--seconds", "nan"}, {"--seconds"});
    require_failure(2, {"run", pinned2, "--seconds", "1e300"}, {"--seconds"});
    require_failure(2, {"run", pinned2, "--seconds", "1", "--frames", "1"}, {"--frames", "--seconds"});
    require_failure(2, {"run", pinned2, "--threads", "0"}, {"--threads"});
    require_failure(2, {"run", pinned2, "--every", "0"}, {"--every"});
    require_failure(2, {"run", pinned2, "--frames", "1", "--csv", "-", "--json"}, {"--csv -"});
    require_failure(2, {"run", pinned2, "--frames", "1", "--csv", "-", "--hash"}, {"--csv -"});
    require_failure(2, {"list"}, {"what"});
    require_failure(2, {"list", "colours"}, {"colours", "integrators"});
    require_failure(2, {"validate"}, {"files"});
    require_failure(2, {"frobnicate", "a", "b"}, {});
    require_failure(2, {"--frobnicate"}, {"--frobnicate"});
    require_failure(2, {"run", pinned2, "validate", pinned2}, {});
}

TEST_CASE("Bad settings end with status 2, the argument and what is allowed", "[program]") {
    const auto require_bad = [](const std::string& setting, const std::vector<std::string>& parts) {
        require_failure(2, {"run", pinned2, "--frames", "1", "--hash", "--set", setting}, parts);
    };
    require_bad("cloth.ksi=1", {"--set cloth.ksi=1", "did you mean cloth.ks?"});
    require_bad("cloth.ks", {"--set cloth.ks", "KEY=VALUE"});
    require_bad("=1", {"KEY=VALUE"});
    require_bad("cloth.ks=", {"no value"});
    require_bad("cloth.ks=stiff", {"cloth.ks", "a number"});
    require_bad("cloth.density=0", {"other than 0"});
    require_bad("cloth.pinned=[[50,0]]", {"cloth.pinned[0]", "outside the grid"});
    require_bad("sphere.radius=1", {"no sphere"});
    require_bad("rules=off", {"cs184"});
    require_bad("simulation.integrator=magic", {"course-verlet"});
    require_bad("cloth.num_width_points=1000000000", {"2048"});
}

TEST_CASE("Settings are applied in their order, and are what the file could have said", "[program]") {
    const auto hash = [](std::vector<std::string> settings) {
        std::vector<std::string> arguments{"run", pinned2, "--frames", "2", "--hash"};
        for (const std::string& setting : settings)
            arguments.insert(arguments.end(), {"--set", setting});
        const Finished finished = clothlab::test::clothlab(arguments);
        REQUIRE(finished.status == 0);
        return finished.out;
    };
    REQUIRE(hash({"cloth.ks=4000", "cloth.ks=5000"}) == hash({}));
    REQUIRE(hash({"cloth.ks=5000", "cloth.ks=4000"}) == hash({"cloth.ks=4000"}));
    REQUIRE(hash({"cloth.ks=4000"}) != hash({}));
    REQUIRE(hash({"cloth.pinned=[[0,0]]"}) != hash({}));
    REQUIRE(hash({"simulation.gravity=0,-1.62,0"}) != hash({}));
    REQUIRE(hash({"rules=cs184"}) == hash({}));
    REQUIRE(hash({"description=a, b = c"}) == hash({}));
    const TemporaryFolder folder;
    std::string text = read_file(pinned2);
    text.replace(text.find("5000.0"), 6, "4000.0");
    write_file(folder / "soft.json", text);
    REQUIRE(clothlab::test::clothlab({"run", (folder / "soft.json").string(), "--frames", "2", "--hash"}).out ==
            hash({"cloth.ks=4000"}));
}

TEST_CASE("Bad scenes end with status 2, whatever is wrong with them", "[program]") {
    const TemporaryFolder folder;
    const std::vector<std::pair<std::string, std::string>> bad{
        {"", "empty"},
        {"{\"cloth\": {}}", "cloth.width"},
        {"{\"cloth\": ", "too early"},
        {"{\"clothlab\": 1, \"cloth\": {\"num_width_points\": 1}}", "from 2 to 2048"},
        {"{\"clothlab\": 1, \"cloth\": {\"ks\": NaN}}", "not valid JSON"},
        {std::string(10'000'000, '['), "nested deeper"},
        {std::string("\x7f"
                     "ELF\0\0\0",
                     7),
         "not valid JSON"},
    };
    const std::string file = (folder / "bad.json").string();
    for (const auto& [text, part] : bad) {
        write_file(file, text);
        require_failure(2, {"run", file, "--frames", "1", "--hash"}, {file, part});
        require_failure(2, {"validate", file}, {file, part});
    }
    for (const std::string& path :
         {folder.path().string(), (folder / "missing.json").string(), std::string("velvet")}) {
        require_failure(2, {"run", path, "--hash"}, {path});
        require_failure(2, {"validate", path}, {path});
    }
}

TEST_CASE("Output that cannot be written ends with status 1 and its name", "[program]") {
    const TemporaryFolder folder;
    const std::string nowhere = (folder / "no" / "such" / "file").string();
    for (const std::string option : {"--csv", "--obj", "--state"})
        for (const std::string& file : {nowhere, folder.path().string(), std::string("/dev/full")})
            require_failure(1, {"run", pinned2, "--frames", "1", "--hash", option, file}, {file, "cannot be written"});
}

TEST_CASE("A full standard output ends with status 1", "[program]") {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"run", pinned2, "--frames", "1", "--hash"},
          {"run", pinned2, "--frames", "1", "--json"},
          {"run", pinned2, "--frames", "1", "--csv", "-"},
          {"list", "parameters"},
          {"validate", pinned2}}) {
        const Finished finished = clothlab::test::clothlab(arguments, "/dev/full");
        REQUIRE(finished.status == 1);
        REQUIRE(finished.err.find("cannot be written") != std::string::npos);
    }
}

TEST_CASE("Without --json a run prints its results as a table, to standard output alone", "[program]") {
    const Finished finished = clothlab::test::clothlab({"run", pinned2, "--frames", "1"});
    REQUIRE(finished.status == 0);
    REQUIRE(finished.err.empty());
    for (const char* part : {"steps ", "energy_J.total ", "hash ", "status "})
        REQUIRE(finished.out.find(part) != std::string::npos);
}

TEST_CASE("validate names every file: the good ones on standard output, the bad ones on standard error", "[program]") {
    const TemporaryFolder folder;
    const std::string bad = (folder / "bad.json").string();
    write_file(bad, "{\n\"cloth\": 1}");
    const Finished finished = clothlab::test::clothlab({"validate", pinned2, bad, "two-pins"});
    REQUIRE(finished.status == 2);
    REQUIRE(finished.out == pinned2 + ": ok\ntwo-pins: ok\n");
    REQUIRE(finished.err.find(bad + ":2: cloth") == 0);
    std::vector<std::string> all{"validate"};
    for (const auto& file : files_of(checkout() / "scenes"))
        all.push_back(file.string());
    REQUIRE(clothlab::test::clothlab(all).status == 0);
}

TEST_CASE("list prints every kind of thing, as a table and as JSON", "[program]") {
    for (const std::string what : {"integrators", "shaders", "rules", "scenes", "parameters"}) {
        INFO(what);
        const Finished table = clothlab::test::clothlab({"list", what});
        const Finished as_json = clothlab::test::clothlab({"list", what, "--json"});
        REQUIRE(table.status == 0);
        REQUIRE(as_json.status == 0);
        REQUIRE((table.err.empty() && as_json.err.empty()));
        const json rows = json::parse(as_json.out);
        REQUIRE(rows.is_array());
        REQUIRE_FALSE(rows.empty());
        for (const json& row : rows) {
            const auto name = row.at("name").get<std::string>();
            REQUIRE_FALSE(name.empty());
            REQUIRE(("\n" + table.out).find("\n" + name) != std::string::npos);
        }
    }
}

TEST_CASE("Every integrator that is listed can be run", "[program]") {
    const json rows = json::parse(clothlab::test::clothlab({"list", "integrators", "--json"}).out);
    for (const json& row : rows) {
        const auto name = row.at("name").get<std::string>();
        const Finished finished = clothlab::test::clothlab(
            {"run", pinned2, "--frames", "1", "--json", "--set", "simulation.integrator=" + name});
        REQUIRE(finished.status == 0);
        REQUIRE(json::parse(finished.out)["integrator"] == name);
    }
}

TEST_CASE("Every scene that is listed can be run by its name", "[program]") {
    const json rows = json::parse(clothlab::test::clothlab({"list", "scenes", "--json"}).out);
    REQUIRE(rows.size() == files_of(checkout() / "scenes").size());
    for (const json& row : rows) {
        const Finished finished =
            clothlab::test::clothlab({"run", row.at("name").get<std::string>(), "--frames", "1", "--json"});
        INFO(finished.err);
        REQUIRE(finished.status == 0);
        REQUIRE(json::parse(finished.out)["status"] == "ok");
    }
}

TEST_CASE("The parameters that are listed are the table's, with defaults that --set takes", "[program]") {
    const json rows = json::parse(clothlab::test::clothlab({"list", "parameters", "--json"}).out);
    REQUIRE(rows.size() == scene::fields().size());
    std::vector<std::string> arguments{"run", pinned2, "--frames", "1", "--hash"};
    const std::string plain = clothlab::test::clothlab(arguments).out;
    for (const json& row : rows) {
        REQUIRE(scene::find_field(row.at("name").get<std::string>()));
        const json& value = row.at("default");
        arguments.insert(arguments.end(), {"--set", row.at("name").get<std::string>() + "=" +
                                                        (value.is_string() ? value.get<std::string>() : value.dump())});
    }
    const Finished finished = clothlab::test::clothlab(arguments);
    INFO(finished.err);
    REQUIRE(finished.status == 0);
    REQUIRE(finished.out == plain); // the course's scene is the defaults
}

TEST_CASE("Help and version go to standard output", "[program]") {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"--help"}, {"--version"}, {"run", "--help"}, {"list", "--help"}}) {
        const Finished finished = clothlab::test::clothlab(arguments);
        REQUIRE(finished.status == 0);
        REQUIRE(finished.out.find("clothlab") != std::string::npos);
        REQUIRE(finished.err.empty());
    }
}

TEST_CASE("A program without its GUI says so where one is needed", "[program]") {
    // Whether this one has a GUI is told by what it says to a picture without a name: usage comes first in both.
    const Finished probe = clothlab::test::clothlab({"render", pinned2, "--size", "0x0", "-o", "picture.png"});
    REQUIRE(probe.status != 0);
    if (probe.err.find("without its GUI") == std::string::npos)
        SKIP("this program has its GUI");
    require_failure(1, {}, {"without its GUI", "--help"});
    require_failure(1, {pinned2}, {"without its GUI"});
    require_failure(1, {"render", pinned2, "-o", "picture.png"}, {"without its GUI"});
}

TEST_CASE("Numbers that are none, infinite or out of range are refused with the option and the value", "[program]") {
    const auto refused = [](const std::vector<std::string>& arguments, const std::string& why) {
        const Finished finished = clothlab::test::clothlab(arguments);
        INFO(finished.err);
        REQUIRE(finished.status == 2);
        REQUIRE(finished.out.empty());
        REQUIRE(finished.err.find(why) != std::string::npos);
    };
    for (const char* value : {"nan", "inf", "-inf", "-1", "1e999"}) {
        const std::string said = "'" + std::string(value) + "' is not a number ";
        refused({"run", "chain", "--seconds", value}, "--seconds: " + said + "from zero on");
        refused({"experiment", "sweep", "chain", "--seconds", value}, "--seconds: " + said + "from zero on");
        refused({"experiment", "accuracy", "chain", "--budget", value}, "--budget: " + said + "above zero");
        refused({"experiment", "needs", "chain", "--tolerance", value}, "--tolerance: " + said + "above zero");
    }
    refused({"run", "chain", "--seconds", "1e300"}, "too long a run");
    for (const char* option : {"--precision", "--from", "--to"})
        refused({"experiment", "stability", "chain", "--bisect", "dt", option, "nan"}, "'nan' is not a finite number");
    refused({"render", "chain", "-o", "x.mp4", "--fps", "nan"}, "'nan' is not a finite number");
}
