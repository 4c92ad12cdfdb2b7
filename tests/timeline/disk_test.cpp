// States on disk: what memory has no room for, and a minute of any cloth.
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "sim/random.h"
#include "support/effort.h"
#include "support/files.h"
#include "support/timelines.h"
#include "timeline/overview.h"

using namespace clothlab;
using namespace clothlab::test;
using namespace clothlab::timeline;

namespace {

std::vector<std::byte> some_bytes(std::size_t count, std::uint64_t seed) {
    sim::SplitMix64 random(seed);
    std::vector<std::byte> bytes(count);
    for (std::byte& byte : bytes)
        byte = static_cast<std::byte>(random.next() & 255);
    return bytes;
}

/// A disk on which files have room for so many bytes, for all of this process.
class SmallDisk {
public:
    explicit SmallDisk(rlim_t bytes) : signal_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        rlimit small = before_;
        small.rlim_cur = bytes;
        ::setrlimit(RLIMIT_FSIZE, &small);
    }
    ~SmallDisk() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, signal_);
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;

private:
    rlimit before_{};
    void (*signal_)(int);
};

void set_disk(Timeline& timeline, std::size_t bytes, const std::filesystem::path& folder = {}) {
    CacheOptions options = timeline.options();
    options.disk = bytes;
    options.disk_folder = folder;
    timeline.set_options(options);
    timeline.fit();
}

/// The first frame that is reachable, and all after it.
std::uint64_t first_reachable(const Timeline& timeline) {
    const Branch& branch = timeline.branches()[0];
    std::uint64_t first = branch.end;
    while (first > 0 && timeline.reachable({branch.id, first - 1}))
        --first;
    return first / 30;
}

} // namespace

TEST_CASE("A scratch file has no name, gives every state back, and is as small as what is in it") {
    const TemporaryFolder folder;
    const auto file = ScratchFile::make(folder.path());
    REQUIRE(files_of(folder.path()).empty());
    std::vector<StoredStatePtr> states;
    for (std::size_t n = 0; n < 50; ++n)
        states.push_back(file->keep(some_bytes(1000 + 37 * n, n)));
    const auto right = [&](std::size_t n) { return states[n]->compressed() == some_bytes(1000 + 37 * n, n); };
    const std::uint64_t size = file->size();
    for (std::size_t n = 0; n < 50; n += 2) // gaps, which are filled again
        states[n].reset();
    REQUIRE(file->size() == size);
    for (std::size_t n = 0; n < 50; n += 2)
        states[n] = file->keep(some_bytes(1000 + 37 * n, n));
    REQUIRE(file->size() == size);
    for (std::size_t n = 0; n < 50; ++n)
        REQUIRE(right(n));
    while (states.size() > 10)
        states.pop_back();
    REQUIRE(file->size() <= 10 * 1400);
    for (std::size_t n = 0; n < 10; ++n)
        REQUIRE(right(n));
    states.clear();
    REQUIRE(file->size() == 0);
}

TEST_CASE("A scratch file is shared by threads", "[threads]") {
    const TemporaryFolder folder;
    const auto file = ScratchFile::make(folder.path());
    std::array<int, 4> wrong{};
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < wrong.size(); ++t)
        threads.emplace_back([&, t] {
            std::vector<std::pair<StoredStatePtr, std::uint64_t>> states(8);
            for (std::uint64_t n = 0; n < (sanitized ? 200 : 2000); ++n) {
                auto& [state, seed] = states[n % states.size()];
                if (state && state->compressed() != some_bytes(100 + seed % 900, seed))
                    ++wrong[t];
                seed = 1000 * n + t;
                state = file->keep(some_bytes(100 + seed % 900, seed));
            }
        });
    for (std::thread& thread : threads)
        thread.join();
    REQUIRE(wrong == std::array<int, 4>{});
    REQUIRE(file->size() == 0);
}

TEST_CASE("A state that a disk has damaged is refused, and one that it cannot take is not kept") {
    const TemporaryFolder folder;
    REQUIRE_THROWS_AS(ScratchFile::make(folder / "none"), std::system_error);
    const auto file = ScratchFile::make(folder.path());
    const StoredStatePtr state = file->keep(some_bytes(5000, 1));
    const std::uint64_t size = file->size();
    {
        const SmallDisk small(8000);
        REQUIRE_THROWS_AS(file->keep(some_bytes(5000, 2)), std::system_error);
        REQUIRE(file->size() == size);
        REQUIRE(state->compressed() == some_bytes(5000, 1));
    }
    // The file by way of what the system knows of this process, as it has no name.
    int found = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
        std::error_code ignored;
        if (!std::filesystem::read_symlink(entry.path(), ignored).string().starts_with(folder.path().string()))
            continue;
        ++found;
        const int descriptor = std::atoi(entry.path().filename().c_str());
        REQUIRE(::pwrite(descriptor, "x", 1, 2500) == 1);
        REQUIRE_THROWS_AS(state->compressed(), std::runtime_error);
        REQUIRE(::ftruncate(descriptor, 2500) == 0);
        REQUIRE_THROWS_AS(state->compressed(), std::runtime_error);
    }
    REQUIRE(found == 1);
}

TEST_CASE("What memory has no room for lies on disk, the oldest first, and both keep within their limits") {
    Timeline timeline = made_up(1 << 20, 400, 2000, 0.1); // each frame's state is needed for a quick seek
    const BranchId id = timeline.branches()[0].id;
    CacheOptions options = timeline.options();
    options.budget = 200'000;
    options.disk = 800'000;
    timeline.set_options(options);
    timeline.fit();
    REQUIRE(timeline.memory() <= 200'000);
    REQUIRE(timeline.on_disk() <= 800'000);
    REQUIRE(timeline.on_disk() > 500'000);
    REQUIRE(widest_gap(timeline.branches()[0]) == 1);
    REQUIRE(first_reachable(timeline) == 0);
    bool in_memory = false;
    for (const Keyframe& keyframe : timeline.branches()[0].keyframes) {
        REQUIRE((!keyframe.state || on_disk(keyframe) == 0 || !in_memory));
        in_memory |= keyframe.state && on_disk(keyframe) == 0;
        if (keyframe.state)
            REQUIRE(keyframe.state->compressed() == std::vector<std::byte>(2000));
    }
    REQUIRE(on_disk(timeline.branches()[0]) == timeline.on_disk());

    // Less room: the oldest go, of all there are.
    set_disk(timeline, 300'000);
    const std::uint64_t first = first_reachable(timeline);
    REQUIRE(timeline.on_disk() <= 300'000);
    REQUIRE(timeline.on_disk() > 280'000);
    REQUIRE(timeline.memory() <= 200'000);
    REQUIRE((first > 100 && first < 300));
    REQUIRE(timeline.reachable({id, 0}));
    // None: memory's states stay.
    const std::size_t memory = timeline.memory();
    set_disk(timeline, 0);
    REQUIRE(timeline.on_disk() == 0);
    REQUIRE(timeline.memory() > memory / 2);
    REQUIRE(first_reachable(timeline) < 350);
    timeline.clear();
    REQUIRE(timeline.on_disk() == 0);
}

TEST_CASE("States thin out as far as seeks stay quick before any is put on disk") {
    Timeline timeline = made_up(100'000, 400, 1000, 0.00099); // ten frames are within a seek's time
    set_disk(timeline, 1 << 20);
    REQUIRE(timeline.on_disk() == 0);
    REQUIRE(first_reachable(timeline) == 0);
    REQUIRE(timeline.memory() <= 100'000);
}

TEST_CASE("With a disk, seconds that are to be kept need no slower seeks") {
    Timeline timeline = made_up(150'000, 600, 2000, 0.003, 5);
    set_disk(timeline, 1 << 20);
    REQUIRE(widest_gap(timeline.branches()[0]) == 3);
    REQUIRE(first_reachable(timeline) == 0);
}

TEST_CASE(
    "A disk that fails costs only what memory has no room for, says why, and is tried again when options are set") {
    const TemporaryFolder folder;
    Timeline timeline = made_up(200'000, 400, 2000, 0.1);
    set_disk(timeline, 1 << 20, folder / "none");
    REQUIRE(timeline.disk_trouble().find("none") != std::string::npos);
    REQUIRE(timeline.memory() <= 200'000);
    REQUIRE(timeline.on_disk() == 0);
    const std::uint64_t first = first_reachable(timeline);
    REQUIRE((first > 200 && first < 390));
    set_disk(timeline, 1 << 20, folder.path());
    REQUIRE(timeline.disk_trouble().empty());
    REQUIRE(first_reachable(timeline) == first);

    // One that is full has as much room as it had: the newest states find it, in the place of the oldest.
    Timeline second = made_up(200'000, 400, 2000, 0.1);
    const SmallDisk small(300'000);
    set_disk(second, 1 << 20, folder.path());
    REQUIRE_FALSE(second.disk_trouble().empty());
    REQUIRE(second.on_disk() > 250'000);
    REQUIRE(second.on_disk() <= 300'000);
    REQUIRE(second.memory() <= 200'000);
    const std::uint64_t before = first_reachable(second);
    REQUIRE((before > 100 && before < 200));
    Branch& branch = *second.find(second.branches()[0].id);
    for (std::uint64_t frame = 401; frame <= 600; ++frame) {
        branch.end = 30 * frame;
        branch.keyframes.back().until = branch.end;
        branch.samples.push_back(sample_of(frame, 0.1));
        second.store(branch.id, {branch.end, branch.end, branch.start, keep_in_memory(some_bytes(2000, frame)), false});
        second.fit();
        REQUIRE(second.memory() <= 200'000);
    }
    REQUIRE(second.on_disk() > 230'000);
    REQUIRE(first_reachable(second) < before + 220);
    for (const Keyframe& keyframe : branch.keyframes)
        if (keyframe.step > 400 * 30)
            REQUIRE(keyframe.state->compressed() == some_bytes(2000, keyframe.step / 30));
}

namespace {

/// Every frame of a minute of 50 x 50 points, 90 frames/s and 30 substeps can be gone to, and is right.
void keeps_a_minute(const sim::Description& description, CacheOptions options) {
    constexpr int frames = 5400;
    options.budget = std::size_t{64} << 20;
    Player player(options);
    player.start(description);
    std::vector<std::uint64_t> hashes{player.simulation().hash()};
    for (int frame = 0; frame < frames; ++frame) {
        for (int n = 0; n < 30; ++n)
            player.step();
        hashes.push_back(player.simulation().hash());
    }
    REQUIRE(player.memory() <= player.options().budget);
    REQUIRE(player.timeline().on_disk() <= player.options().disk);
    const Overview o = overview(player);
    REQUIRE(o.reachable.size() == 1);
    REQUIRE(o.reachable[0].first == 0);
    REQUIRE(o.reachable[0].last == static_cast<std::uint64_t>(frames));
    sim::SplitMix64 random(1);
    for (int n = 0; n < 40; ++n) {
        const std::uint64_t frame = random.next() % hashes.size();
        REQUIRE(hash_at(player, 30 * frame) == hashes[frame]);
        REQUIRE(player.memory() <= player.options().budget);
    }
}

} // namespace

TEST_CASE("With 64 MB a 50 x 50 cloth keeps a minute of frames reachable, exactly") {
    if (sanitized) // what they play and seek, others do in seconds
        return;
    sim::Description description; // the course's
    description.cloth.pinned = {{0, 0}, {49, 0}};
    CacheOptions options;
    options.seek_s *= 4; // for a machine that has other work
    keeps_a_minute(description, options);
}

TEST_CASE("With 64 MB and a disk it does so where states are large and steps are dear, and no seek is slower") {
    if (sanitized) // what they play and seek, others do in seconds
        return;
    sim::Description description; // in folds, whose doubles hardly compress
    description.cloth.orientation = sim::Orientation::vertical;
    description.colliders = {sim::Plane{{0, 0, 0}, {0, 1, 0}, 0.5}};
    description.stepping.precision = sim::Precision::double_precision;
    CacheOptions options;
    options.disk = std::size_t{1} << 30;
    keeps_a_minute(description, options);
}
