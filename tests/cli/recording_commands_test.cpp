// The commands that write and read recordings: run --record, run --resume, export, validate.
#include "support/recordings.h"
#include "support/run.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

Finished refused(int status, const std::vector<std::string>& arguments, const std::string& part) {
    Finished finished = clothlab::test::clothlab(arguments);
    INFO(finished.err);
    REQUIRE(finished.status == status);
    REQUIRE(finished.out.empty());
    REQUIRE(finished.err.find(part) != std::string::npos);
    return finished;
}

std::string succeeded(const std::vector<std::string>& arguments) {
    const Finished finished = clothlab::test::clothlab(arguments);
    INFO(finished.err);
    REQUIRE(finished.status == 0);
    REQUIRE(finished.err.empty());
    return finished.out;
}

} // namespace

TEST_CASE("run --record changes no bit of the run and records every frame, as the lab would", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = small_scene(folder), file = (folder / "a.clothrec").string();
    REQUIRE(run(scene, {"--frames", "9", "--hash", "--record", file}) == run(scene, {"--frames", "9", "--hash"}));
    const timeline::Recording recorded = timeline::load_recording(file);
    REQUIRE(recorded.damage.empty());
    REQUIRE(recorded.scene == scene::load_scene(scene));
    timeline::Player player;
    player.start(recorded.scene.simulation);
    for (int n = 0; n < 9 * 4; ++n)
        player.step();
    const timeline::Branch &a = recorded.timeline.branches().at(0), &b = player.timeline().branches().at(0);
    REQUIRE(a.keyframes.size() == 10);
    REQUIRE(a.samples.size() == 9);
    REQUIRE(a.marks.size() == b.marks.size());
    for (std::size_t i = 0; i < a.samples.size(); ++i) {
        REQUIRE(a.samples[i].spring == b.samples[i].spring);
        REQUIRE(a.samples[i].contacts == b.samples[i].contacts);
    }
    REQUIRE(hashes_of(recorded.timeline, a.id) == hashes_of(player.timeline(), b.id));
    REQUIRE(files_of(folder.path()).size() == 2);
}

TEST_CASE("A run goes on from a recording's end or any of its frames, and is recorded further", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = small_scene(folder), file = (folder / "a.clothrec").string(),
                      more = (folder / "b.clothrec").string(), state = (folder / "a.state").string();
    for (const std::string precision : {"simulation.precision=single", "simulation.precision=double"}) {
        run(scene, {"--frames", "6", "--record", file, "--state", state, "--set", precision});
        const std::string hash = run(scene, {"--frames", "10", "--hash", "--set", precision});
        REQUIRE(succeeded({"run", "--resume", file, "--frames", "4", "--hash"}) == hash);
        REQUIRE(succeeded({"run", "--resume", file, "--at", "3", "--frames", "7", "--hash", "--record", more}) == hash);
        REQUIRE(run(scene, {"--resume", file, "--frames", "4", "--hash", "--set", precision}) == hash);
        REQUIRE(run(scene, {"--resume", state, "--frames", "4", "--hash", "--set", precision, "--record", more}) ==
                hash);
        const timeline::Recording recorded = timeline::load_recording(more);
        REQUIRE(recorded.timeline.branches().at(0).fork_step == 6 * 4);
        REQUIRE(recorded.timeline.branches().at(0).end == 10 * 4);
        REQUIRE(succeeded({"run", "--resume", more, "--at", "7", "--frames", "3", "--hash"}) == hash);
        // With other parameters: without a scene they are the recording's, but for what is set.
        REQUIRE(
            succeeded({"run", "--resume", file, "--frames", "4", "--hash", "--set", "cloth.ks=100"}) ==
            run(scene, {"--resume", state, "--frames", "4", "--hash", "--set", precision, "--set", "cloth.ks=100"}));
    }
}

TEST_CASE("A run goes on from the playhead of the line that the lab showed, with the parameters in force",
          "[program]") {
    const TemporaryFolder folder;
    const std::string file = (folder / "a.clothrec").string();
    timeline::Recording recording = busy_recording(5, 5, sim::Precision::single_precision);
    recording.at = {2, 25}; // after a change of parameters
    timeline::save_recording(recording, file);
    timeline::Reader reader;
    reader.seek(recording.timeline, recording.at);
    reader.simulation().step_frame();
    char hash[32];
    std::snprintf(hash, sizeof hash, "%016llx\n", static_cast<unsigned long long>(reader.simulation().hash()));
    REQUIRE(succeeded({"run", "--resume", file, "--frames", "1", "--hash"}) == hash);
}

TEST_CASE("What cannot be resumed is refused before the run", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = small_scene(folder), file = (folder / "a.clothrec").string(),
                      state = (folder / "a.state").string();
    run(scene, {"--frames", "4", "--record", file, "--state", state});
    refused(2, {"run", "--resume", file, "--at", "5"}, "--at 5");
    refused(2, {"run", scene, "--at", "1"}, "--resume");
    refused(2, {"run", scene, "--resume", state, "--at", "1"}, "is not a recording");
    refused(2, {"run", "--resume", state}, "name a scene");
    refused(2, {"run", "two-pins", "--resume", file}, "7 x 6");
    refused(2, {"run", "--resume", (folder / "none").string()}, "name a scene");
    refused(1, {"run", scene, "--frames", "1", "--record", (folder / "no" / "a.clothrec").string()},
            "cannot be written");
    refused(1, {"run", scene, "--frames", "1", "--state", (folder / "no" / "a.state").string()}, "cannot be written");
    write_file(folder / "head.clothrec", read_file(file).substr(0, 100));
    refused(2, {"run", "--resume", (folder / "head.clothrec").string()}, "nothing of it can be used");
}

TEST_CASE("run --state leaves the old state where the new one cannot be written whole", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = small_scene(folder), state = (folder / "a.state").string();
    run(scene, {"--frames", "1", "--state", state});
    const std::string bytes = read_file(state);
    std::filesystem::create_directory(state + ".part"); // in the way
    refused(1, {"run", scene, "--frames", "2", "--hash", "--state", state}, state + ": cannot be written");
    REQUIRE(read_file(state) == bytes);
}

TEST_CASE("export writes the frames of a range of a branch as meshes", "[program]") {
    const TemporaryFolder folder;
    const std::string file = (folder / "a.clothrec").string(), meshes = (folder / "meshes").string();
    timeline::save_recording(busy_recording(5, 5, sim::Precision::single_precision), file);
    REQUIRE(succeeded({"export", file, "-o", meshes, "--branch", "Run 1", "--frames", "2:6", "--every", "2"}) ==
            "wrote 3 meshes to " + meshes + "\n");
    REQUIRE(files_of(meshes).size() == 3);
    REQUIRE(succeeded({"export", file, "-o", meshes, "--branch", "Branch 2", "--format", "ply", "--frames", ":1"}) ==
            "wrote 2 meshes to " + meshes + "\n");
    REQUIRE(std::filesystem::exists(folder / "meshes/cloth_0001.ply"));
    refused(2, {"export", file, "-o", meshes, "--branch", "Branch 9"}, "Run 1, Branch 2");
    refused(2, {"export", file, "-o", meshes, "--frames", "6:2"}, "--frames 6:2");
    refused(2, {"export", file, "-o", meshes, "--frames", "2"}, "FIRST:LAST");
    refused(2, {"export", file, "-o", meshes, "--frames", "2:x"}, "FIRST:LAST");
    refused(2, {"export", file, "-o", meshes, "--frames", "900:"}, "the last frame");
    refused(2, {"export", file, "-o", meshes, "--format", "abc"}, "--format");
    refused(2, {"export", file}, "--output");
    refused(2, {"export", (folder / "none").string(), "-o", meshes}, "none: cannot be read");
    refused(1, {"export", file, "-o", file}, file + ": ");
}

TEST_CASE("validate says what is in a recording, and what is missing from a damaged one", "[program]") {
    const TemporaryFolder folder;
    const std::string file = (folder / "a.clothrec").string();
    timeline::save_recording(busy_recording(5, 6, sim::Precision::double_precision), file);
    const std::string out = succeeded({"validate", file});
    for (const std::string& part :
         std::vector<std::string>{file + ": ok\n", "  Run 1: frames 0 to ", "5 x 6 points", "double precision",
                                  ", from Run 1", "bookmark \"half-way\": frame "})
        REQUIRE(out.find(part) != std::string::npos);
    std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    const Finished damaged = clothlab::test::clothlab({"validate", file});
    REQUIRE(damaged.status == 2);
    REQUIRE(damaged.err.find(file + ": damaged at byte ") == 0);
    REQUIRE(damaged.out.find("  Run 1: frames 0 to ") == 0);
    write_file(file, "no recording");
    refused(2, {"validate", file}, file + ": it is not a recording");
}
