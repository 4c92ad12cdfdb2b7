// Recordings: all of a timeline comes back, and states are read, not computed.
#include "timeline/recording.h"

#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>

#include "scene/fields.h"
#include "support/effort.h"
#include "support/random_scene.h"
#include "support/recordings.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

bool same_clock(const timeline::FrameClock& a, const timeline::FrameClock& b) {
    return a.step == b.step && a.frame == b.frame && a.substep == b.substep && a.substeps == b.substeps &&
           a.time == b.time && a.dt == b.dt;
}

bool same_sample(const timeline::Sample& a, const timeline::Sample& b) {
    return a.frame == b.frame && a.time == b.time && a.kinetic == b.kinetic && a.spring == b.spring &&
           a.gravity == b.gravity && a.max_strain == b.max_strain && a.contacts == b.contacts &&
           a.self_contacts == b.self_contacts && a.shortened_springs == b.shortened_springs &&
           a.stage_seconds == b.stage_seconds;
}

bool same_mark(const timeline::Mark& a, const timeline::Mark& b) {
    return a.kind == b.kind && a.step == b.step && a.frame == b.frame && a.value == b.value && a.text == b.text;
}

bool same_change(const timeline::Change& a, const timeline::Change& b) {
    return a.step == b.step && *a.description == *b.description;
}

bool same_bookmark(const timeline::Bookmark& a, const timeline::Bookmark& b) {
    return a.moment == b.moment && a.frame == b.frame && a.substep == b.substep && a.name == b.name &&
           a.camera == b.camera;
}

template <class T, class Same>
void require_same(const std::vector<T>& a, const std::vector<T>& b, Same same) {
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        REQUIRE(same(a[i], b[i]));
}

void require_same(const timeline::Timeline& a, const timeline::Timeline& b) {
    REQUIRE(a.branches().size() == b.branches().size());
    for (std::size_t i = 0; i < a.branches().size(); ++i) {
        const timeline::Branch &x = a.branches()[i], &y = b.branches()[i];
        INFO("branch " << x.name);
        REQUIRE(x.id == y.id);
        REQUIRE(x.name == y.name);
        REQUIRE(x.parent == y.parent);
        REQUIRE(x.fork_step == y.fork_step);
        REQUIRE(x.end == y.end);
        REQUIRE(x.stem == y.stem);
        REQUIRE(*x.start == *y.start);
        REQUIRE(x.trouble == y.trouble);
        REQUIRE(x.trouble_step == y.trouble_step);
        require_same(x.changes, y.changes, same_change);
        require_same(x.clocks, y.clocks, same_clock);
        require_same(x.samples, y.samples, same_sample);
        require_same(x.marks, y.marks, same_mark);
    }
    require_same(a.bookmarks(), b.bookmarks(), same_bookmark);
}

} // namespace

TEST_CASE("A recording comes back with its branches, changes, marks, bookmarks and playhead, and every state's bits") {
    const auto precision = GENERATE(sim::Precision::single_precision, sim::Precision::double_precision);
    const TemporaryFolder folder;
    const timeline::Recording saved = busy_recording(5, 6, precision);
    REQUIRE(saved.timeline.branches().size() == 4);
    REQUIRE(saved.timeline.bookmarks().size() == 2);
    REQUIRE_FALSE(saved.timeline.branches()[0].marks.empty());
    timeline::save_recording(saved, folder / "a.clothrec");
    const timeline::Recording loaded = timeline::load_recording(folder / "a.clothrec");
    REQUIRE(loaded.damage.empty());
    REQUIRE(loaded.scene == saved.scene);
    REQUIRE(loaded.at == saved.at);
    require_same(saved.timeline, loaded.timeline);
    for (const timeline::Branch& branch : saved.timeline.branches()) {
        const auto hashes = hashes_of(saved.timeline, branch.id);
        REQUIRE(hashes.size() == branch.end - branch.fork_step + 1);
        REQUIRE(hashes_of(loaded.timeline, branch.id) == hashes);
    }
    REQUIRE(files_of(folder.path()).size() == 1);

    // And again, from the file: states go from file to file.
    timeline::save_recording(loaded, folder / "b.clothrec");
    timeline::save_recording(loaded, folder / "a.clothrec"); // over the very file that they come from
    REQUIRE(read_file(folder / "b.clothrec") == read_file(folder / "a.clothrec"));
    REQUIRE(hashes_of(loaded.timeline, 1) == hashes_of(saved.timeline, 1));
}

TEST_CASE("A recording has a state for every frame's end and every line's end: scrubbing computes nothing") {
    const TemporaryFolder folder;
    const timeline::Recording saved = busy_recording(5, 6, single);
    timeline::save_recording(saved, folder / "a.clothrec");
    const timeline::Recording loaded = timeline::load_recording(folder / "a.clothrec");
    for (const timeline::Branch& branch : loaded.timeline.branches()) {
        const auto stored = [&](std::uint64_t step) {
            const timeline::Keyframe* keyframe = timeline::keyframe_before(branch, step);
            return keyframe && keyframe->step == step;
        };
        const std::uint64_t last = frame_time(branch, branch.end).frame;
        for (std::uint64_t frame = branch.clocks.front().frame; frame <= last; ++frame)
            REQUIRE(stored(step_of_frame(branch, frame)));
        REQUIRE(stored(branch.end));
        for (const timeline::Keyframe& keyframe : branch.keyframes)
            REQUIRE((keyframe.state || keyframe.step == 0));
    }
}

TEST_CASE("The states of a recording stay in the file until they are wanted") {
    const TemporaryFolder folder;
    timeline::save_recording(busy_recording(40, 40, single), folder / "a.clothrec");
    const timeline::Recording loaded = timeline::load_recording(folder / "a.clothrec");
    REQUIRE(loaded.timeline.memory() < std::filesystem::file_size(folder / "a.clothrec") / 20);
}

TEST_CASE("What was dropped from the cache is not in the recording, and all that is left is") {
    const TemporaryFolder folder;
    timeline::Recording saved;
    saved.scene.simulation = recorded_cloth(12, 12);
    timeline::Player player({.budget = 60'000, .seek_s = 0, .least_reach_s = 0});
    player.start(saved.scene.simulation);
    for (int frame = 0; frame < 60; ++frame)
        for (int step = 0; step < 4; ++step)
            player.step();
    saved.timeline = player.timeline();
    saved.at = player.moment();
    const auto hashes = hashes_of(saved.timeline, 1);
    REQUIRE(hashes.size() < 200);
    REQUIRE(hashes.size() > 20);
    timeline::save_recording(saved, folder / "a.clothrec");
    const timeline::Recording loaded = timeline::load_recording(folder / "a.clothrec");
    REQUIRE(loaded.damage.empty());
    require_same(saved.timeline, loaded.timeline);
    REQUIRE(hashes_of(loaded.timeline, 1) == hashes);
}

TEST_CASE("A loaded recording is played on, edited and saved as if it had never been closed") {
    const TemporaryFolder folder;
    const sim::Description start = recorded_cloth(6, 5);
    sim::Description other = start;
    other.cloth.ks = 700;
    timeline::Player straight, resumed;
    straight.start(start);
    for (int n = 0; n < 4; ++n)
        straight.step();
    REQUIRE(straight.timeline().branches()[0].marks.back().step == 4); // the end itself is marked
    timeline::save_recording({{}, straight.timeline(), straight.moment(), {}}, folder / "a.clothrec");
    timeline::Recording loaded = timeline::load_recording(folder / "a.clothrec");
    require_same(straight.timeline(), loaded.timeline);
    resumed.adopt(std::move(loaded.timeline), loaded.at);
    for (timeline::Player* player : {&straight, &resumed}) {
        for (int n = 0; n < 12; ++n)
            player->step();
        player->seek(11);
        player->change(other);
        for (int n = 0; n < 6; ++n)
            player->step();
    }
    REQUIRE(resumed.simulation().hash() == straight.simulation().hash());
    timeline::save_recording({{}, resumed.timeline(), resumed.moment(), {}}, folder / "a.clothrec");
    const timeline::Recording again = timeline::load_recording(folder / "a.clothrec");
    for (const timeline::BranchId id : {1u, 2u})
        REQUIRE(hashes_of(again.timeline, id) == hashes_of(straight.timeline(), id));
}

TEST_CASE("A blow-up is in the recording, with states that are not finite") {
    const TemporaryFolder folder;
    sim::Description unstable = recorded_cloth(4, 4);
    unstable.cloth.ks = 1e9;
    unstable.rules.limit = sim::LimitRule::off;
    timeline::Player player;
    player.start(unstable);
    for (int n = 0; n < 400; ++n)
        player.step();
    REQUIRE(player.timeline().branches()[0].trouble);
    timeline::save_recording({{}, player.timeline(), player.moment(), {}}, folder / "a.clothrec");
    const timeline::Recording loaded = timeline::load_recording(folder / "a.clothrec");
    REQUIRE(loaded.timeline.branches()[0].trouble == player.timeline().branches()[0].trouble);
    REQUIRE(loaded.timeline.branches()[0].trouble_step == player.timeline().branches()[0].trouble_step);
    REQUIRE(hashes_of(loaded.timeline, 1) == hashes_of(player.timeline(), 1));
}

TEST_CASE("The scene of a recording is the one that was saved, whatever is in it") {
    const TemporaryFolder folder;
    timeline::Recording saved = busy_recording(3, 3, single);
    for (int seed = 0; seed < attempts(10); ++seed) {
        saved.scene = RandomScene(static_cast<std::uint64_t>(seed)).scene();
        timeline::save_recording(saved, folder / "a.clothrec");
        REQUIRE(timeline::load_recording(folder / "a.clothrec").scene == saved.scene);
    }
}
