// Saving, loading and exporting beside the window.
#include "app/core/recording_job.h"

#include <catch2/catch_test_macros.hpp>
#include <chrono>

#include "support/recordings.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

app::RecordingJob::Result result_of(app::RecordingJob& job) {
    job.wait();
    REQUIRE_FALSE(job.status());
    std::optional<app::RecordingJob::Result> result = job.take_result();
    REQUIRE(result);
    REQUIRE_FALSE(job.take_result());
    return std::move(*result);
}

/// What takes for ever to save: the start of a run, of which millions of steps are said to be known.
timeline::Recording endless_recording() {
    timeline::Recording recording;
    recording.scene.simulation = recorded_cloth(20, 20);
    const auto start = std::make_shared<const sim::Description>(recording.scene.simulation);
    timeline::FrameClock clock;
    clock.substeps = start->stepping.substeps;
    clock.dt = sim::step_length(*start);
    const timeline::BranchId id = recording.timeline.add_root(start, clock);
    constexpr std::uint64_t steps = 10'000'000;
    recording.timeline.find(id)->end = steps;
    recording.timeline.store(id, {0, steps, start, nullptr, false});
    recording.at = {id, 0};
    return recording;
}

} // namespace

TEST_CASE("A job saves, loads and exports in its own thread and says what it came to", "[threads]") {
    const TemporaryFolder folder;
    const auto file = folder / "fold.clothrec";
    const timeline::Recording recording = busy_recording(6, 6, single);
    app::RecordingJob job;
    REQUIRE_FALSE(job.status());
    REQUIRE_FALSE(job.take_result());

    REQUIRE(job.save(recording, file));
    app::RecordingJob::Result result = result_of(job);
    REQUIRE(result.succeeded);
    REQUIRE(result.text.find("Saved fold.clothrec, 0.0 MB.") == 0);
    REQUIRE(timeline::load_recording(file).damage.empty());

    REQUIRE(job.load(file));
    result = result_of(job);
    REQUIRE(result.succeeded);
    REQUIRE(result.loaded);
    REQUIRE(result.loaded->timeline.branches().size() == recording.timeline.branches().size());

    timeline::MeshSequence sequence;
    sequence.folder = folder / "meshes";
    sequence.line = 1;
    sequence.frames = {1, 3};
    REQUIRE(job.write_meshes(recording.timeline, sequence));
    result = result_of(job);
    REQUIRE(result.succeeded);
    REQUIRE(result.text == "Wrote 3 meshes to " + (folder / "meshes").string() + ".");
    REQUIRE(files_of(folder / "meshes").size() == 3);

    REQUIRE(job.load(folder / "missing"));
    result = result_of(job);
    REQUIRE_FALSE(result.succeeded);
    REQUIRE_FALSE(result.loaded);
    REQUIRE(result.text.find((folder / "missing").string() + ": ") == 0);
}

TEST_CASE("A job that is cancelled, or whose window closes, ends soon and leaves the old file", "[threads]") {
    const TemporaryFolder folder;
    const auto file = folder / "a.clothrec";
    write_file(file, "old");
    const timeline::Recording recording = endless_recording();
    app::RecordingJob job;
    REQUIRE(job.save(recording, file));
    while (job.status() && job.status()->share == 0)
        std::this_thread::sleep_for(std::chrono::microseconds(100));
    REQUIRE(job.status());
    REQUIRE(job.status()->what == "Saving a.clothrec");
    REQUIRE_FALSE(job.save(recording, folder / "b.clothrec")); // one at a time
    job.cancel();
    const app::RecordingJob::Result result = result_of(job);
    REQUIRE_FALSE(result.succeeded);
    REQUIRE(result.cancelled);
    REQUIRE(result.text.find("cancelled") != std::string::npos);
    REQUIRE(read_file(file) == "old");
    {
        app::RecordingJob closing;
        REQUIRE(closing.save(recording, file));
    }
    REQUIRE(read_file(file) == "old");
    REQUIRE(files_of(folder.path()).size() == 1);
}
