// Steps that several threads take many at once: the bits of single steps, and only where a step is nothing but springs.
#include "sim/slabs.h"

#include <catch2/catch_message.hpp>
#include <catch2/catch_template_test_macros.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>

#include "sim/simulation.h"
#include "support/effort.h"
#include "support/every_execution.h"
#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

/// From cloths that several threads can hardly share to such as have several vectors in each row, with pins anywhere.
sim::Description random_springs(sim::SplitMix64& random) {
    const auto below = [&](std::uint64_t end) { return static_cast<int>(random.next() % end); };
    const int columns = below(4) == 0 ? 2 + below(6) : 2 + below(90);
    const int rows = std::max(8, 300 / columns) + below(60);
    sim::Description d = bare_cloth(columns, rows);
    vary_springs(d.cloth, random);
    d.cloth.ks = uniform(random, 20, 500);
    d.stepping.gravity = {0.3, -9.8, 0.1};
    d.stepping.substeps = 20 + below(40);
    d.stepping.seed = below(1000);
    for (int pins = below(6); pins > 0; --pins)
        d.cloth.pinned.push_back({below(static_cast<std::uint64_t>(columns)), below(static_cast<std::uint64_t>(rows))});
    return d;
}

template <class Real>
void require_same_steps(std::uint64_t seed) {
    sim::SplitMix64 random(seed);
    const sim::Description description = random_springs(random);
    Sheet<Real> plain(description, exactly(sim::InstructionSet::scalar, 1));
    const double amount = uniform(random, 0, 0.1) * static_cast<double>(plain.model.grid->shortest);
    for (std::size_t i = 0; i < plain.points(); ++i) {
        const sim::Vec3 x = plain.position(i), r = uniform_point(random, -amount, amount);
        Sheet<Real>::put(plain.state.position, i, {x.x + r.x, x.y + r.y, x.z + r.z});
    }
    const sim::State<Real> before = plain.state;
    const int batches[] = {sim::least_slab_steps, sim::most_slab_steps, 7};
    for (const int steps : batches)
        for (int i = 0; i < steps; ++i)
            plain.step();
    for (const sim::InstructionSet set : supported_sets()) {
        if (set == sim::InstructionSet::scalar)
            continue;
        for (const int threads : {2, 3, 5}) {
            Sheet<Real> sheet(description, exactly(set, threads));
            sheet.state = before;
            for (std::uint64_t i = 0; i < seed % 50; ++i)
                sheet.work.pace.learn(seed % 2 == 0);
            INFO("seed " << seed << ", " << name_of(set) << ", " << threads << " threads, "
                         << description.cloth.num_width_points << " x " << description.cloth.num_height_points);
            for (const int steps : batches)
                if (sim::can_step_in_slabs(sheet.model, sheet.work))
                    sim::step_in_slabs(sheet.model, sheet.state, sheet.work, steps);
                else
                    for (int i = 0; i < steps; ++i)
                        sheet.step();
            REQUIRE(sheet.state == plain.state);
        }
    }
}

bool in_slabs(const sim::Description& description, const sim::Execution& execution) {
    Sheet<float> sheet(description, execution);
    return sim::can_step_in_slabs(sheet.model, sheet.work);
}

/// The best kernels on two threads; one more would be as good.
sim::Execution two_threads() {
    return exactly(sim::resolve(sim::InstructionSet::automatic), 2);
}

bool no_vectors() {
    return sim::resolve(sim::InstructionSet::automatic) == sim::InstructionSet::scalar;
}

} // namespace

TEMPLATE_TEST_CASE("Many steps at once have the bits of as many single ones, whatever the cloth and the threads",
                   "[threads]", float, double) {
    for (std::uint64_t seed = 0; seed < attempts(30); ++seed)
        require_same_steps<TestType>(seed);
}

TEST_CASE("Steps are taken many at once where they are nothing but springs, and nowhere else", "[threads]") {
    if (no_vectors())
        SKIP("no vectors here");
    const sim::Description springs = bare_cloth(20, 40);
    CHECK(in_slabs(springs, two_threads()));
    CHECK_FALSE(in_slabs(springs, exactly(two_threads().instructions, 1)));
    CHECK_FALSE(in_slabs(springs, exactly(sim::InstructionSet::scalar, 2)));
    CHECK_FALSE(in_slabs(bare_cloth(20, 7), two_threads())); // a thread's part would be all of the other's border
    CHECK_FALSE(in_slabs(bare_cloth(1000, 700), two_threads()));
    const auto with = [&](auto change) {
        sim::Description other = springs;
        change(other);
        return in_slabs(other, two_threads());
    };
    CHECK(with([](sim::Description& d) { d.cloth.pinned = {{0, 0}}; }));
    CHECK(with([](sim::Description& d) { d.cloth.damping = 0.5; }));
    CHECK_FALSE(with([](sim::Description& d) { d.rules.limit = sim::LimitRule::cs184; }));
    CHECK_FALSE(with([](sim::Description& d) { d.rules.self_collision = sim::SelfCollisionRule::cs184; }));
    CHECK_FALSE(with([](sim::Description& d) { d.colliders = {sim::Plane{{0, -9, 0}, {0, 1, 0}, 0.5}}; }));
    CHECK_FALSE(with([](sim::Description& d) { d.wind.kind = sim::WindKind::course; }));
    CHECK_FALSE(with([](sim::Description& d) { d.stepping.integrator = sim::IntegratorId::rk4; }));
    CHECK_FALSE(with([](sim::Description& d) { d.stepping.gravity = {-0.0, -9.8, 0.0}; }));
}

TEST_CASE("A run that advances by many steps is the run that takes them one by one, watched and changed on its way",
          "[threads]") {
    sim::Description description = bare_cloth(30, 30);
    description.cloth.pinned = {{0, 0}, {29, 0}};
    description.cloth.damping = 0.2;
    description.stepping.gravity = {0, -9.8, 0};
    description.stepping.substeps = 9;
    const bool watched = GENERATE(false, true);
    const auto whole = sim::Simulation::create(description, two_threads());
    const auto single = sim::Simulation::create(description, exactly(sim::InstructionSet::scalar, 1));
    for (const auto& simulation : {whole.get(), single.get()})
        simulation->watch(watched);
    const auto go_on = [&](int steps) {
        sim::StepCounts sum;
        for (int i = 0; i < steps; ++i)
            sum += single->step();
        REQUIRE(whole->advance(steps).force_evaluations == sum.force_evaluations);
        REQUIRE(whole->hash() == single->hash());
        REQUIRE(whole->time() == single->time());
        REQUIRE(whole->steps() == single->steps());
        REQUIRE(whole->frame() == single->frame());
        REQUIRE(whole->substep() == single->substep());
        REQUIRE(whole->trouble() == single->trouble());
    };
    for (const int steps : {0, 1, 3, 40, 5, 100})
        go_on(steps);
    const auto change = [&](auto edit) {
        edit(description);
        whole->change(description);
        single->change(description);
    };
    change([](sim::Description& d) { d.cloth.ks *= 0.5; });
    go_on(50);
    change([](sim::Description& d) { d.rules.limit = sim::LimitRule::cs184; });
    go_on(20);
    change([](sim::Description& d) { d.rules.limit = sim::LimitRule::off; });
    go_on(20);
    // Far beyond the stability limit: who watches sees it, in the same frame.
    change([](sim::Description& d) { d.cloth.ks = 1e7; });
    whole->advance(60);
    for (int i = 0; i < 60; ++i)
        single->step();
    REQUIRE(whole->trouble().has_value() == watched);
    REQUIRE(whole->trouble() == single->trouble());
}
