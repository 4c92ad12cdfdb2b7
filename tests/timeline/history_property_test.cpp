// Whatever is done to a timeline, the state is that of a straight run with the same changes at the same steps.
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/generators/catch_generators_range.hpp>
#include <cstring>
#include <map>

#include "sim/integrators/integrator.h"
#include "sim/random.h"
#include "sim/saved_state.h"
#include "support/effort.h"
#include "support/files.h"
#include "timeline/player.h"
#include "timeline/recording.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

/// Small, but with all that a step may have to do: pins, contacts, wind, folds, and a limit that is met.
sim::Description busy_cloth(const sim::IntegratorInfo& method, sim::Precision precision) {
    sim::Description description;
    description.cloth.num_width_points = 9;
    description.cloth.num_height_points = 12;
    description.cloth.thickness = 0.03;
    description.cloth.ks = 300;
    description.cloth.pinned = {{0, 0}};
    description.colliders = {sim::Sphere{{0.5, 0.9, 0.5}, 0.15, 0.3}, sim::Plane{{0, 0.8, 0}, {0, 1, 0}, 0.5}};
    description.wind.kind = sim::WindKind::physical;
    description.stepping.precision = precision;
    description.stepping.integrator = method.id;
    description.stepping.iterations = 4;
    description.stepping.substeps = 6;
    return description;
}

/// What was done on a line, told apart from the timeline's own books.
struct Story {
    sim::Description start;
    std::vector<std::pair<std::uint64_t, sim::Description>> changes;

    std::uint64_t hash_after(std::uint64_t steps) const {
        const auto run = sim::Simulation::create(start);
        std::size_t next = 0;
        for (;;) {
            for (; next < changes.size() && changes[next].first == run->steps(); ++next)
                run->change(changes[next].second);
            if (run->steps() == steps)
                return run->hash();
            run->step();
        }
    }
};

class Session {
public:
    Session(std::uint64_t seed, const sim::Description& description, int threads)
        : random_(seed),
          player_({.budget = 200'000, .seek_s = 0.0005, .disk = seed % 2 == 0 ? std::size_t{200'000} : 0},
                  {.threads = threads, .fewer_if_faster = threads == 1}) {
        player_.start(description);
        stories_[player_.line()] = {description, {}};
    }

    void act() {
        const std::uint64_t end = player_.timeline().find(player_.line())->end;
        switch (below(10)) {
        case 0:
        case 1:
        case 2:
            last_ = "play";
            for (std::uint64_t n = 1 + below(40); n-- > 0;)
                player_.step();
            break;
        case 3:
            last_ = "step back";
            if (player_.moment().step > 0)
                player_.seek(player_.moment().step - 1);
            break;
        case 4:
            last_ = "seek";
            player_.seek(below(end + 1));
            break;
        case 5:
            last_ = "edit";
            edit();
            return;
        case 6: { // to and fro, as a slider is dragged
            last_ = "drag";
            const sim::Description origin = player_.simulation().description();
            for (int n = 0; n < 3; ++n)
                edit();
            if (below(2) == 0) // and back to where it was
                change(origin);
            return;
        }
        case 7: {
            last_ = "switch";
            const auto& branches = player_.timeline().branches();
            player_.switch_to(branches[below(branches.size())].id);
            break;
        }
        case 8: {
            last_ = "save and load";
            const auto file = folder_ / "session.clothrec";
            timeline::save_recording({{}, player_.timeline(), player_.moment(), {}}, file);
            timeline::Recording loaded = timeline::load_recording(file);
            REQUIRE(loaded.damage.empty());
            REQUIRE(loaded.at == player_.moment());
            player_ = timeline::Player(player_.options(), execution_);
            player_.adopt(std::move(loaded.timeline), loaded.at);
            break;
        }
        default:
            last_ = "bookmark";
            player_.bookmark({}, {});
            return; // the state is still the one that the last change was made at
        }
        before_.reset();
    }

    /// The state, that of a simulation which goes on from it, and the reader's own of another moment.
    void check() {
        const timeline::Moment moment = player_.moment();
        const Story& story = stories_.at(player_.line());
        INFO("after " << last_ << " at step " << moment.step << " of branch " << moment.branch << ", "
                      << story.changes.size() << " changes");
        REQUIRE(player_.simulation().hash() == story.hash_after(moment.step));
        const auto resumed = sim::Simulation::create(player_.simulation().description());
        resumed->load_state(player_.simulation().save_state());
        REQUIRE(resumed->hash() == player_.simulation().hash());
    }

private:
    std::uint64_t below(std::uint64_t n) { return random_.next() % n; }

    void edit() {
        sim::Description description = player_.simulation().description();
        switch (below(5)) {
        case 0:
            description.cloth.ks = 100 + 50 * static_cast<double>(below(10));
            break;
        case 1:
            description.cloth.enable_bending = !description.cloth.enable_bending;
            break;
        case 2:
            description.stepping.substeps = 3 + static_cast<int>(below(6));
            break;
        case 3:
            description.cloth.pinned = {{static_cast<int>(below(9)), 0}};
            break;
        default:
            description.cloth.density = 100 + 20 * static_cast<double>(below(10));
            break;
        }
        change(description);
    }

    /// The player's rule, told once more: a change is made at the present step, in place of the one that was made there
    /// just before; what came later on the line is no part of it.
    void change(const sim::Description& description) {
        const std::uint64_t step = player_.moment().step;
        if (!before_) {
            if (description == player_.simulation().description())
                return;
            before_ = stories_.at(player_.line());
        }
        Story story = *before_;
        std::erase_if(story.changes, [&](const auto& c) { return c.first > step; });
        const bool nothing = description == (story.changes.empty() ? story.start : story.changes.back().second);
        player_.change(description);
        if (nothing) {
            REQUIRE(stories_.count(player_.line()) == 1); // no branch without a change
            stories_[player_.line()] = *before_;
            before_.reset();
        } else {
            story.changes.push_back({step, description});
            stories_[player_.line()] = story;
        }
    }

    TemporaryFolder folder_;
    sim::SplitMix64 random_;
    sim::Execution execution_;
    timeline::Player player_;
    std::map<timeline::BranchId, Story> stories_;
    std::optional<Story> before_; ///< of the line shown before the change that another one may take the place of
    std::string last_;
};

void play_with(const sim::IntegratorInfo& method, sim::Precision precision, int threads, std::uint64_t seed) {
    Session session(seed, busy_cloth(method, precision), threads);
    for (int n = 0; n < (sanitized ? 12 : 40); ++n) {
        session.act();
        session.check();
    }
}

} // namespace

TEST_CASE("Whatever is done to a timeline, its states are those of a straight run, for every method", "[threads]") {
    const sim::IntegratorInfo method = GENERATE(from_range(sim::integrators().begin(), sim::integrators().end()));
    INFO(method.name);
    for (const sim::Precision precision : {sim::Precision::single_precision, sim::Precision::double_precision})
        for (const int threads : {1, 4}) {
            if (sanitized && (threads == 4) != (precision == sim::Precision::single_precision))
                continue;
            for (std::uint64_t seed = 1; seed <= (sanitized ? 1 : 2); ++seed) {
                INFO((precision == sim::Precision::single_precision ? "single" : "double")
                     << " precision, " << threads << " threads, seed " << seed);
                play_with(method, precision, threads, seed * 1000 + static_cast<std::uint64_t>(threads));
            }
        }
}

TEST_CASE("A hash does not match by chance: one bit of one coordinate makes another") {
    const auto run = sim::Simulation::create(busy_cloth(sim::integrators()[0], sim::Precision::single_precision));
    for (int n = 0; n < 20; ++n)
        run->step();
    std::vector<std::byte> state = run->save_state();
    const sim::StateHeader header = sim::read_state_header(state);
    std::uint64_t seen = 0;
    for (std::size_t number = 0; number < header.array_bytes() / sizeof(float); number += 97) {
        std::vector<std::byte> flipped = state;
        flipped[sizeof header + number * sizeof(float)] ^= std::byte{1};
        const std::span<std::byte> all(flipped);
        const std::uint64_t sum = sim::checksum(all.first(flipped.size() - sizeof(std::uint64_t)));
        std::memcpy(flipped.data() + flipped.size() - sizeof sum, &sum, sizeof sum);
        const auto other = sim::Simulation::create(run->description());
        other->load_state(flipped);
        REQUIRE(other->hash() != run->hash());
        REQUIRE(other->hash() != seen);
        seen = other->hash();
    }
}
