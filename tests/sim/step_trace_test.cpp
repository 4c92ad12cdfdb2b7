// Looking into a step: it shows what the step then does, to the last bit, and the run does not notice.
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "sim/collision/colliders.h"
#include "sim/collision/self_collision.h"
#include "sim/forces/gravity.h"
#include "sim/forces/springs.h"
#include "sim/integrators/integrator.h"
#include "sim/simulation.h"
#include "sim/step_recorder.h"
#include "sim/stretch_limit.h"
#include "support/choices.h"
#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr auto forces = static_cast<std::size_t>(sim::Stage::forces);
constexpr auto integrate = static_cast<std::size_t>(sim::Stage::integrate);
constexpr auto self_collision = static_cast<std::size_t>(sim::Stage::self_collision);
constexpr auto colliders = static_cast<std::size_t>(sim::Stage::colliders);
constexpr auto limit = static_cast<std::size_t>(sim::Stage::limit);

/// Within a few frames every stage has something to do.
sim::Description busy_scene(sim::IntegratorId method, sim::Precision precision) {
    sim::Description d;
    d.cloth.num_width_points = 9;
    d.cloth.num_height_points = 8;
    d.cloth.ks = 200;
    d.cloth.thickness = 0.07;
    d.cloth.orientation = sim::Orientation::vertical;
    d.cloth.pinned = {{0, 0}};
    d.colliders = {sim::Sphere{{0.5, 0.4, 0.1}, 0.2, 0.2}, sim::Plane{{0, 0.01, 0}, {0, 1, 0.01}, 0.4}};
    d.stepping.integrator = method;
    d.stepping.precision = precision;
    d.stepping.substeps = 12;
    d.stepping.seed = 4;
    return d;
}

std::vector<std::size_t> numbers(const sim::StepCounts& c) {
    return {c.self_contacts, c.contacts, c.shortened_springs, c.force_evaluations, c.solver_iterations};
}

std::vector<double> numbers(const sim::Energy& e) {
    return {e.kinetic, e.spring, e.gravity};
}

template <class Real>
sim::Vec3Array<Real> positions(const std::vector<float>& interleaved) {
    sim::Vec3Array<Real> x;
    x.resize(interleaved.size() / 3);
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            x.axes()[axis][i] = static_cast<Real>(interleaved[3 * i + axis]);
    return x;
}

double distance_to(const std::vector<float>& x, std::size_t i, sim::Vec3 centre) {
    return std::hypot(double(x[3 * i]) - centre.x, double(x[3 * i + 1]) - centre.y, double(x[3 * i + 2]) - centre.z);
}

/// The cloth's start with random displacements of up to `most` m.
sim::Vec3Array<double> crumpled(const Sheet<double>& sheet, double most) {
    sim::SplitMix64 random(5);
    sim::Vec3Array<double> x = sheet.state.position;
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            x.axes()[axis][i] += uniform(random, -most, most);
    return x;
}

sim::Vec3 at(const std::vector<float>& x, std::size_t i) {
    return {double(x[3 * i]), double(x[3 * i + 1]), double(x[3 * i + 2])};
}

} // namespace

TEST_CASE("A run that is looked into before every step is the one that nobody looked into, for every method") {
    for (const sim::IntegratorInfo& method : sim::integrators()) {
        for (const sim::Precision precision : both_precisions) {
            const sim::Description description = busy_scene(method.id, precision);
            const auto quiet = sim::Simulation::create(description), seen = sim::Simulation::create(description);
            for (const auto& run : {quiet.get(), seen.get()})
                run->watch(true);
            seen->time_stages(true);
            INFO(method.name << (precision == sim::Precision::single_precision ? " single" : " double"));
            sim::Snapshot a, b;
            std::array<std::size_t, sim::stage_count> moved{};
            for (int n = 0; n < 150; ++n) {
                const std::vector<std::byte> before = seen->save_state();
                const sim::StageSeconds seconds = seen->stage_seconds();
                const std::size_t memory = seen->memory_bytes();
                const sim::StepTrace trace = seen->trace_step();
                REQUIRE(seen->save_state() == before);
                REQUIRE(seen->stage_seconds() == seconds);
                REQUIRE(seen->memory_bytes() == memory);
                REQUIRE(trace.step == seen->steps());
                seen->capture(a);
                REQUIRE(trace.before == a.positions);

                const sim::StepCounts counts = seen->step();
                REQUIRE(numbers(counts) == numbers(quiet->step()));
                REQUIRE(numbers(counts) == numbers(trace.counts));
                REQUIRE(seen->save_state() == quiet->save_state());
                REQUIRE(seen->trouble() == quiet->trouble());
                seen->capture(a);
                quiet->capture(b);
                REQUIRE(numbers(a.counts) == numbers(b.counts));
                REQUIRE(trace.after[limit] == a.positions);
                REQUIRE(numbers(trace.energy[limit]) == numbers(a.diagnostics.energy));
                REQUIRE(trace.max_strain[limit] == a.diagnostics.max_strain);
                REQUIRE(trace.dt == a.dt);
                for (std::size_t s = 0; s < moved.size(); ++s)
                    moved[s] += trace.moved[s];
            }
            CHECK(moved[forces] == 0);
            CHECK(moved[integrate] > 0);
            CHECK(moved[self_collision] > 0);
            CHECK(moved[colliders] > 0);
            CHECK(moved[limit] > 0);
        }
    }
}

TEST_CASE("What a step need not compute again, looking into it does not either") {
    sim::Description description = bare_cloth(6, 5);
    description.stepping.integrator = sim::IntegratorId::velocity_verlet;
    const auto run = sim::Simulation::create(description);
    for (const std::size_t evaluations : {2u, 1u, 1u}) {
        CHECK(run->trace_step().counts.force_evaluations == evaluations);
        CHECK(run->step().force_evaluations == evaluations);
    }
}

TEST_CASE("A run with a trouble has the same one when it is looked into") {
    sim::Description description = busy_scene(sim::IntegratorId::course_verlet, sim::Precision::single_precision);
    description.cloth.ks = 5e6;
    for (const sim::LimitRule rule : {sim::LimitRule::off, sim::LimitRule::cs184}) {
        description.rules.limit = rule;
        const auto quiet = sim::Simulation::create(description), seen = sim::Simulation::create(description);
        for (const auto& run : {quiet.get(), seen.get()})
            run->watch(true);
        for (int n = 0; n < 360; ++n) {
            seen->trace_step();
            seen->step();
            quiet->step();
        }
        REQUIRE(quiet->trouble());
        CHECK(seen->trouble() == quiet->trouble());
        CHECK(seen->hash() == quiet->hash());
    }
}

TEST_CASE("Every instruction set and number of threads shows the same inside of a step", "[threads]") {
    const sim::Description description = busy_scene(sim::IntegratorId::course_verlet, sim::Precision::single_precision);
    std::optional<sim::StepTrace> first;
    for (const sim::InstructionSetInfo& set : sim::instruction_sets()) {
        if (!sim::is_supported(set.id))
            continue;
        const auto run =
            sim::Simulation::create(description, {.instructions = set.id, .threads = 4, .fewer_if_faster = false});
        for (int n = 0; n < 60; ++n)
            run->step();
        const sim::StepTrace trace = run->trace_step();
        if (!first)
            first = trace;
        INFO(set.name);
        CHECK(trace.after == first->after);
        CHECK(trace.force == first->force);
    }
}

TEST_CASE("Each stage of a step moves what that stage alone moves") {
    const sim::Description description = busy_scene(sim::IntegratorId::course_verlet, sim::Precision::single_precision);
    const auto run = sim::Simulation::create(description);
    std::array<int, sim::stage_count> steps_that_move{};
    for (int n = 0; n < 200; ++n) {
        const sim::StepTrace trace = run->trace_step();
        Sheet<float> sheet(description);
        sheet.state.previous = positions<float>(trace.before); // what Verlet leaves there
        const auto alone = [&](std::size_t stage, auto resolve) {
            sheet.state.position = positions<float>(trace.after[stage - 1]);
            const sim::Vec3Array<float> from = sheet.state.position;
            resolve(sheet.model, sheet.state, sheet.work);
            REQUIRE(sheet.state.position == positions<float>(trace.after[stage]));
            steps_that_move[stage] += sheet.state.position == from ? 0 : 1;
            REQUIRE((trace.moved[stage] == 0) == (sheet.state.position == from));
        };
        alone(self_collision, sim::resolve_self_collision<float>);
        alone(colliders, sim::resolve_colliders<float>);
        alone(limit, sim::limit_stretch<float>);
        run->step();
    }
    CHECK(steps_that_move[self_collision] > 10);
    CHECK(steps_that_move[colliders] > 10);
    CHECK(steps_that_move[limit] > 10);
}

TEST_CASE("Colliders move the points inside a sphere, and those alone, to its surface") {
    sim::Description description;
    description.cloth.num_width_points = description.cloth.num_height_points = 12;
    description.rules.self_collision = sim::SelfCollisionRule::none;
    const sim::Sphere sphere{{0.5, 0.5, 0.5}, 0.4, 0};
    description.colliders = {sphere};
    const auto run = sim::Simulation::create(description);
    std::size_t put_out = 0;
    for (int n = 0; n < 600; ++n) {
        const sim::StepTrace trace = run->trace_step();
        std::size_t inside = 0;
        for (std::size_t i = 0; i < run->points(); ++i) {
            const double from = distance_to(trace.after[self_collision], i, sphere.origin);
            const bool moved = at(trace.after[self_collision], i) != at(trace.after[colliders], i);
            if (std::abs(from - sphere.radius) > 1e-6)
                REQUIRE(moved == (from < sphere.radius));
            inside += moved ? 1 : 0;
            if (moved)
                REQUIRE_THAT(distance_to(trace.after[colliders], i, sphere.origin), WithinAbs(sphere.radius, 1e-6));
        }
        REQUIRE(trace.moved[colliders] == inside);
        put_out += inside;
        run->step();
    }
    CHECK(put_out > 100);
}

TEST_CASE("The limit shortens what the method stretched by more than 10 %") {
    sim::Description description;
    description.cloth.num_width_points = description.cloth.num_height_points = 8;
    description.cloth.ks = 20;
    description.cloth.orientation = sim::Orientation::vertical;
    description.cloth.pinned = {{0, 0}, {7, 0}};
    description.rules.self_collision = sim::SelfCollisionRule::none;
    const auto run = sim::Simulation::create(description);
    for (int n = 0; n < 30 && run->trace_step().moved[limit] == 0; ++n)
        run->step_frame();
    const sim::StepTrace trace = run->trace_step();
    CHECK(trace.counts.shortened_springs > 0);
    CHECK(trace.moved[limit] > 0);
    CHECK(trace.max_strain[colliders] > 0.1);
    CHECK(trace.max_strain[limit] < trace.max_strain[colliders]);
}

TEST_CASE("Displacements are those of the positions, in root mean square, at most, and whose") {
    const auto run = sim::Simulation::create(busy_scene(sim::IntegratorId::rk4, sim::Precision::single_precision));
    for (int n = 0; n < 60; ++n)
        run->step();
    const sim::StepTrace trace = run->trace_step();
    for (std::size_t s = 1; s < sim::stage_count; ++s) {
        double sum = 0, most = 0;
        std::size_t moved = 0, furthest = 0;
        for (std::size_t i = 0; i < run->points(); ++i) {
            const double d = distance_to(trace.after[s], i, at(trace.after[s - 1], i));
            sum += d * d;
            moved += d > 0 ? 1 : 0;
            if (d > most) {
                most = d;
                furthest = i;
            }
        }
        INFO(sim::stage_names[s]);
        CHECK(trace.moved[s] == moved);
        CHECK_THAT(trace.max_moved[s], WithinRel(most, 1e-9));
        CHECK_THAT(trace.rms_moved[s], WithinRel(std::sqrt(sum / double(run->points())), 1e-9));
        CHECK(trace.furthest[s] == furthest);
    }
}

TEST_CASE("The forces of a step are minus the gradient of the energy") {
    sim::Description description = bare_cloth(6, 5);
    description.stepping.gravity = {0.3, -9.8, 0.1};
    description.cloth.pinned = {{0, 0}};
    Sheet<double> sheet(description);
    sheet.state.position = sheet.state.previous = crumpled(sheet, 0.05);
    sim::StepTrace trace;
    sim::StepRecorder<double>(trace).begin(sheet.model, sheet.state, sheet.work);
    const auto energy = [&] {
        return sim::spring_energy(sheet.model, sheet.state.position) +
               sim::gravity_energy(sheet.model, sheet.state.position);
    };
    double largest = 0;
    for (const float f : trace.force)
        largest = std::max(largest, std::abs(double(f)));
    REQUIRE(largest > 1);
    constexpr double h = 1e-6;
    for (std::size_t i = 0; i < sheet.points(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            double& x = sheet.state.position.axes()[axis][i];
            const double middle = x;
            x = middle + h;
            const double above = energy();
            x = middle - h;
            const double below = energy();
            x = middle;
            REQUIRE_THAT(double(trace.force[3 * i + axis]), WithinAbs(-(above - below) / (2 * h), 1e-6 * largest));
        }
}

TEST_CASE("In free fall the force on every point is its weight, pinned or not") {
    for (const sim::IntegratorInfo& method : sim::integrators()) {
        sim::Description description = bare_cloth(5, 4);
        description.stepping.integrator = method.id;
        description.stepping.gravity = {0, -9.8, 0};
        description.cloth.pinned = {{1, 1}};
        description.cloth.enable_structural = description.cloth.enable_shearing = description.cloth.enable_bending =
            false;
        const sim::StepTrace trace = sim::Simulation::create(description)->trace_step();
        INFO(method.name);
        REQUIRE(trace.mass == sim::point_mass(description.cloth));
        for (std::size_t i = 0; i < 20; ++i)
            REQUIRE(at(trace.force, i) == sim::Vec3{0, double(float(trace.mass * -9.8)), 0});
    }
}

TEST_CASE("Wind is one of the forces, and so is damping by a rate, but for methods that multiply the motion") {
    for (const sim::IntegratorInfo& method : sim::integrators()) {
        sim::Description still = bare_cloth(6, 5), windy = still, damped = still;
        for (sim::Description* d : {&still, &windy, &damped}) {
            d->stepping.integrator = method.id;
            d->stepping.gravity = {0, -9.8, 0};
        }
        windy.wind.kind = sim::WindKind::physical;
        windy.wind.velocity = {0, 5, 0};
        damped.rules.damping = sim::DampingRule::physical;
        damped.cloth.damping_rate = 3;
        const auto run = sim::Simulation::create(still);
        run->step_frame();
        const sim::StepTrace of_still = run->trace_step();
        run->change(windy);
        const sim::StepTrace of_windy = run->trace_step();
        run->change(damped);
        const sim::StepTrace of_damped = run->trace_step();
        const std::size_t middle = 2 * 6 + 3;
        INFO(method.name);
        CHECK(at(of_windy.force, middle).y > at(of_still.force, middle).y + 1e-3);
        // It has fallen for a frame by now, and a force against that points up.
        const double speed = 9.8 / 90, expected = method.exact_damping ? 0 : 3 * of_still.mass * speed;
        CHECK_THAT(at(of_damped.force, middle).y - at(of_still.force, middle).y,
                   WithinAbs(expected, 0.05 * 3 * of_still.mass * speed));
    }
}

TEST_CASE("Stages that a model does not have are told, and show what the stage before left") {
    sim::Description description = bare_cloth(5, 5);
    description.stepping.gravity = {0, -9.8, 0};
    const auto trace_of = [](const sim::Description& d) { return sim::Simulation::create(d)->trace_step(); };
    const sim::StepTrace bare = trace_of(description);
    CHECK(bare.active == std::array{true, true, false, false, false});
    CHECK(bare.after[limit] == bare.after[integrate]);
    CHECK(bare.after[forces] == bare.before);
    CHECK(bare.after[integrate] != bare.before);
    CHECK(bare.energy[limit].total() == bare.energy[integrate].total());

    description.rules.self_collision = sim::SelfCollisionRule::cs184;
    CHECK(trace_of(description).active == std::array{true, true, true, false, false});
    description.cloth.thickness = 0; // no two points are nearer than that
    CHECK(trace_of(description).active == std::array{true, true, false, false, false});
    description.colliders = {sim::Plane{}};
    CHECK(trace_of(description).active == std::array{true, true, false, true, false});
    description.rules.limit = sim::LimitRule::iterated;
    CHECK(trace_of(description).active == std::array{true, true, false, true, true});
}
