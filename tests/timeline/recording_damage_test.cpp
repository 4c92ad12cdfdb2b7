// What is cut, flipped, killed or full: a recording is whole, or says what is missing; an old one stays.
#include <catch2/catch_test_macros.hpp>
#include <csignal>
#include <set>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "sim/random.h"
#include "support/effort.h"
#include "support/recordings.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

using States = std::map<std::pair<timeline::BranchId, std::uint64_t>, std::vector<std::byte>>;

States states_of(const timeline::Timeline& timeline) {
    States states;
    for (const timeline::Branch& branch : timeline.branches())
        for (const timeline::Keyframe& keyframe : branch.keyframes)
            if (keyframe.state)
                states[{branch.id, keyframe.step}] = keyframe.state->compressed();
    return states;
}

void put(const std::filesystem::path& file, std::size_t at, char byte) {
    std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
    stream.seekp(static_cast<std::streamoff>(at)).put(byte);
    REQUIRE(stream.flush());
}

/// A few frames of a tiny cloth, with a branch.
timeline::Recording tiny_recording() {
    timeline::Recording recording;
    recording.scene.simulation = recorded_cloth(3, 3);
    timeline::Player player;
    player.start(recording.scene.simulation);
    sim::Description changed = recording.scene.simulation;
    const auto change = [&](double ks) {
        changed.cloth.ks = ks;
        player.change(changed);
    };
    for (int n = 0; n < 9; ++n)
        player.step();
    change(400); // within a frame
    for (int n = 0; n < 3; ++n)
        player.step();
    change(500); // at a frame's end, and at the line's
    player.bookmark("here", {});
    player.seek(5);
    change(200);
    for (int n = 0; n < 4; ++n)
        player.step();
    recording.timeline = player.timeline();
    recording.at = player.moment();
    return recording;
}

/// How many states a damaged file gives, all of them right; -1: it is refused. Either is said in a sentence.
int states_left(const std::filesystem::path& file, const States& whole) {
    try {
        const timeline::Recording loaded = timeline::load_recording(file);
        REQUIRE(loaded.damage.find(file.string() + ": damaged at byte ") == 0);
        REQUIRE(loaded.damage.size() > file.string().size() + 60);
        REQUIRE(loaded.damage.back() == '.');
        const States left = states_of(loaded.timeline);
        for (const auto& [moment, state] : left)
            REQUIRE(whole.at(moment) == state);
        REQUIRE(loaded.timeline.reachable(loaded.at));
        for (const timeline::Branch& branch : loaded.timeline.branches()) {
            REQUIRE(branch.keyframes.back().until == branch.end);
            REQUIRE((branch.changes.empty() || branch.changes.back().step <= branch.end));
            REQUIRE(branch.clocks.front().step == branch.fork_step);
            for (const timeline::Keyframe& keyframe : branch.keyframes) {
                const sim::Description* in_force = branch.start.get();
                for (const timeline::Change& change : branch.changes)
                    if (change.step <= keyframe.step)
                        in_force = change.description.get();
                REQUIRE(*keyframe.description == *in_force);
            }
        }
        return static_cast<int>(left.size());
    } catch (const timeline::RecordingError& e) {
        const std::string sentence = e.what();
        REQUIRE(sentence.find(file.string() + ": ") == 0);
        REQUIRE(sentence.size() > file.string().size() + 20);
        return -1;
    }
}

} // namespace

TEST_CASE("A recording cut at any byte is refused, or loaded up to the cut with a sentence that says so") {
    const TemporaryFolder folder;
    const auto file = folder / "a.clothrec";
    timeline::save_recording(tiny_recording(), file);
    const States whole = states_of(timeline::load_recording(file).timeline);
    std::set<int> seen;
    int last = static_cast<int>(whole.size());
    for (std::uintmax_t size = std::filesystem::file_size(file); size > 0;) {
        size -= std::min<std::uintmax_t>(size, sanitized ? 29 : 3);
        std::filesystem::resize_file(file, size);
        const int left = states_left(file, whole);
        INFO(size);
        REQUIRE(left <= last); // more of the file is not less of the recording
        seen.insert(last = left);
    }
    for (int left = 0; left <= static_cast<int>(whole.size()); ++left)
        REQUIRE(seen.count(left) == 1); // every beginning of it could be had
    REQUIRE(seen.count(-1) == 1);
}

TEST_CASE("A recording with any bit flipped is refused, or loaded up to it with a sentence that says so") {
    const TemporaryFolder folder;
    const auto file = folder / "a.clothrec";
    timeline::save_recording(tiny_recording(), file);
    const States whole = states_of(timeline::load_recording(file).timeline);
    const std::string bytes = read_file(file);
    sim::SplitMix64 random(1);
    int most = -1;
    for (std::size_t at = 0; at < bytes.size(); at += 1 + random.next() % (sanitized ? 70 : 7)) {
        put(file, at, static_cast<char>(bytes[at] ^ static_cast<char>(1u << random.next() % 8)));
        INFO("byte " << at);
        const int left = states_left(file, whole);
        if (at < 12 + 24)
            REQUIRE(left == -1);
        most = std::max(most, left);
        put(file, at, bytes[at]);
    }
    REQUIRE(most == static_cast<int>(whole.size())); // the end chunk alone was hit
}

TEST_CASE("A state that was changed in the file after it was loaded is not shown as if it were right") {
    const TemporaryFolder folder;
    const auto file = folder / "a.clothrec";
    timeline::save_recording(tiny_recording(), file);
    const timeline::Recording loaded = timeline::load_recording(file);
    const timeline::Branch& branch = loaded.timeline.branches().at(0);
    const std::vector<std::byte> state = branch.keyframes.back().state->compressed();
    const std::string bytes = read_file(file);
    const std::size_t at = bytes.find(std::string(reinterpret_cast<const char*>(state.data()), state.size()));
    put(file, at + state.size() / 2, static_cast<char>(~bytes[at + state.size() / 2]));
    timeline::Reader reader;
    REQUIRE_THROWS_AS(reader.seek(loaded.timeline, {branch.id, branch.end}), std::runtime_error);
    std::filesystem::resize_file(file, at);
    REQUIRE_THROWS_AS(reader.seek(loaded.timeline, {branch.id, branch.end}), std::runtime_error);
    reader.seek(loaded.timeline, {branch.id, 5});
}

TEST_CASE("The sentence about a cut recording says what is missing") {
    const TemporaryFolder folder;
    const auto file = folder / "a.clothrec";
    timeline::save_recording(busy_recording(8, 8, single), file);
    const auto size = std::filesystem::file_size(file);
    std::filesystem::resize_file(file, size / 4); // among the first run's frames
    const std::string damage = timeline::load_recording(file).damage;
    INFO(damage);
    REQUIRE(damage.find("damaged at byte ") != std::string::npos);
    REQUIRE(damage.find(" of " + std::to_string(size / 4) + ", in chunk ") != std::string::npos);
    REQUIRE(damage.find("missing: what comes after frame ") != std::string::npos);
    REQUIRE(damage.find("all of \"Run 4\"") != std::string::npos);
}

TEST_CASE("What is no recording is refused with its name, and nothing is loaded") {
    const TemporaryFolder folder;
    const auto refused = [&](const std::filesystem::path& file, const std::string& why) {
        try {
            timeline::load_recording(file);
            FAIL("loaded");
        } catch (const timeline::RecordingError& e) {
            INFO(e.what());
            REQUIRE(std::string(e.what()).find(file.string() + ": ") == 0);
            REQUIRE(std::string(e.what()).find(why) != std::string::npos);
        }
    };
    write_file(folder / "empty", "");
    write_file(folder / "text", "This is no recording but a text of some length.");
    refused(folder / "empty", "not a recording");
    refused(folder / "text", "not a recording");
    refused(folder / "missing", "No such file");
    refused(folder.path(), "directory");
    timeline::save_recording(tiny_recording(), folder / "later");
    std::string later = read_file(folder / "later");
    later[8] = 2;
    write_file(folder / "later", later);
    refused(folder / "later", "of version 2; this program reads 1");
}

TEST_CASE("Whenever a save is killed, the file is the old or the new recording, whole") {
    const TemporaryFolder folder;
    const auto file = folder / "a.clothrec";
    const timeline::Recording small = tiny_recording(), large = busy_recording(20, 20, single);
    timeline::save_recording(large, folder / "large");
    timeline::save_recording(small, file);
    const std::set<std::string> possible{read_file(file), read_file(folder / "large")};
    sim::SplitMix64 random(7);
    std::set<std::string> seen;
    int interrupted = 0;
    // On a slow machine none of the first gets through, or all of them: then there are more, which are given more time.
    const int kills = attempts(200);
    for (int n = 0; n < kills || (n < 10 * kills && (seen.size() < 2 || interrupted == 0)); ++n) {
        const pid_t child = ::fork();
        REQUIRE(child >= 0);
        if (child == 0) {
            for (bool which = n % 2 == 0;; which = !which)
                timeline::save_recording(which ? large : small, file);
        }
        const std::uint64_t most_us = 9000 + (n < kills ? 0 : 1000 * static_cast<std::uint64_t>(n - kills));
        ::usleep(static_cast<useconds_t>(random.next() % most_us));
        ::kill(child, SIGKILL);
        int status = 0;
        REQUIRE(::waitpid(child, &status, 0) == child);
        REQUIRE(WIFSIGNALED(status)); // it did not fail
        const std::string bytes = read_file(file);
        REQUIRE(possible.count(bytes) == 1);
        seen.insert(bytes);
        interrupted += std::filesystem::exists(folder / "a.clothrec.part");
    }
    REQUIRE(seen.size() == 2);
    REQUIRE(interrupted > 0);
    REQUIRE(timeline::load_recording(file).damage.empty());
    timeline::save_recording(small, file); // takes over what the killed ones left
    REQUIRE(files_of(folder.path()).size() == 2);
}

TEST_CASE("A recording that cannot be written says why, leaves the old one whole and nothing else behind") {
    const TemporaryFolder folder;
    const auto file = folder / "a.clothrec";
    const timeline::Recording recording = busy_recording(20, 20, single);
    const auto refused = [&](const std::filesystem::path& target, const std::string& why) {
        try {
            timeline::save_recording(recording, target);
            FAIL("saved");
        } catch (const timeline::RecordingError& e) {
            INFO(e.what());
            REQUIRE(std::string(e.what()).find(target.string() + ": ") == 0);
            REQUIRE(std::string(e.what()).find(why) != std::string::npos);
        }
    };
    write_file(file, "old");
    refused(folder / "no" / "folder" / "a.clothrec", "No such file or directory");
    refused(folder.path(), "Is a directory");
    refused("/dev/full", "No space left on device");

    // A disk that fills up half-way: the system refuses to let the file grow further.
    rlimit before{};
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
    const rlimit less{20'000, before.rlim_max};
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &less) == 0);
    refused(file, "File too large");
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &before) == 0);
    std::signal(SIGXFSZ, handler);
    REQUIRE(read_file(file) == "old");
    REQUIRE(files_of(folder.path()) == std::vector{file});

    timeline::save_recording(recording, file);
    REQUIRE(timeline::load_recording(file).damage.empty());
}

TEST_CASE("Saving reports how much is done and can be cancelled at any moment, and the old file stays") {
    const TemporaryFolder folder;
    const auto file = folder / "a.clothrec";
    const timeline::Recording recording = busy_recording(5, 5, single);
    std::vector<double> shares;
    timeline::save_recording(recording, file, {}, [&](double share) {
        shares.push_back(share);
        return true;
    });
    REQUIRE(std::is_sorted(shares.begin(), shares.end()));
    REQUIRE(shares.back() == 1.0);
    const std::string bytes = read_file(file);
    for (std::size_t calls = 1; calls <= shares.size(); ++calls) {
        std::size_t called = 0;
        REQUIRE_THROWS_AS(timeline::save_recording(recording, file, {}, [&](double) { return ++called < calls; }),
                          timeline::RecordingError);
        REQUIRE(called == calls);
    }
    REQUIRE(read_file(file) == bytes);
    REQUIRE(files_of(folder.path()).size() == 1);
}

TEST_CASE("An empty timeline is no recording") {
    const TemporaryFolder folder;
    const timeline::Recording nothing;
    REQUIRE_THROWS_AS(timeline::save_recording(nothing, folder / "a.clothrec"), timeline::RecordingError);
    REQUIRE(files_of(folder.path()).empty());
}
