// Where methods fail, to the third digit, and that it is said: on both sides of the stability limit of the default
// cloth, with time, place and cause.
#include <algorithm>
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <filesystem>

#include "scene/io.h"
#include "sim/simulation.h"
#include "support/allocations.h"
#include "support/effort.h"
#include "support/files.h"
#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinRel;

namespace {

/// The default cloth (50 x 50, 1 m², ks 5000 N/m, 150 kg/m², 0.2 % per step, dt = 1/2700 s), without stretch limit and
/// self-collision.
sim::Description default_cloth() {
    sim::Description description;
    description.rules.limit = sim::LimitRule::off;
    description.rules.self_collision = sim::SelfCollisionRule::none;
    description.stepping.precision = sim::Precision::double_precision;
    return description;
}

struct Run {
    Sheet<double> sheet;
    sim::Monitor<double> monitor;
    std::uint64_t frame = 0;

    /// Points start up to a micrometre beside their places, at rest.
    explicit Run(const sim::Description& description) : sheet(description) {
        sim::SplitMix64 random(3);
        for (std::size_t i = 0; i < sheet.points(); ++i) {
            const sim::Vec3 x = sheet.position(i), r = uniform_point(random, -1e-6, 1e-6);
            if (!sheet.model.pinned[i])
                sheet.place(i, {x.x + r.x, x.y + r.y, x.z + r.z});
        }
        monitor.begin(sheet.state);
    }
    void step_frame() {
        for (int i = 1; i < sheet.model.substeps; ++i)
            sheet.step();
        monitor.before_last_step(sheet.state);
        sheet.step();
        monitor.end_of_frame(sheet.model, sheet.state, ++frame);
    }
    sim::Status status() const { return monitor.trouble() ? monitor.trouble()->status : sim::Status::ok; }
    /// Runs until there is trouble, for so many frames at most.
    sim::Status after(int frames) {
        while (status() == sim::Status::ok && frame < static_cast<std::uint64_t>(frames))
            step_frame();
        return status();
    }
    sim::StabilityMargin margin() const { return sim::stability_margin(sheet.model, sheet.state); }
};

sim::Status falls_for_a_second(const sim::Description& description) {
    Run run(description);
    INFO("margin: omega dt = " << run.margin().omega_dt << ", limit " << run.margin().limit);
    const bool stable = run.margin().stable();
    const sim::Status status = run.after(90);
    REQUIRE(stable == (status == sim::Status::ok)); // the margin knew it
    return status;
}

/// The number before " substeps would do" in a cause.
int substeps_that_would_do(const std::string& cause) {
    const std::size_t end = cause.find(" substeps would do"), begin = cause.rfind("; ", end);
    REQUIRE(end != std::string::npos);
    return std::stoi(cause.substr(begin + 2, end - begin - 2));
}

} // namespace

TEST_CASE("Free default cloth falls soundly with ks 218 600 and is gone with 218 800") {
    sim::Description description = default_cloth();
    description.cloth.ks = 218600;
    REQUIRE(falls_for_a_second(description) == sim::Status::ok);
    description.cloth.ks = 218800;
    REQUIRE(falls_for_a_second(description) == sim::Status::diverged);
}

TEST_CASE("Free default cloth falls soundly with 3.43 kg/m² and is gone with 3.42") {
    sim::Description description = default_cloth();
    description.cloth.density = 3.43;
    REQUIRE(falls_for_a_second(description) == sim::Status::ok);
    description.cloth.density = 3.42;
    REQUIRE(falls_for_a_second(description) == sim::Status::diverged);
}

TEST_CASE("Free default cloth falls soundly with 5 substeps a frame and is gone with 4") {
    sim::Description description = default_cloth();
    description.stepping.substeps = 5;
    REQUIRE(falls_for_a_second(description) == sim::Status::ok);
    description.stepping.substeps = 4;
    REQUIRE(falls_for_a_second(description) == sim::Status::diverged);
}

TEST_CASE("Hung by four corners, ks 218 600 is gone within a second, and the live margin says so before") {
    sim::Description description = default_cloth();
    description.cloth.ks = 218600;
    description.cloth.pinned = {{0, 0}, {49, 0}, {0, 49}, {49, 49}};
    Run run(description);
    REQUIRE(run.margin().stable()); // as long as there is no tension
    std::uint64_t warned = 0;
    while (run.status() == sim::Status::ok && run.frame < 90) {
        run.step_frame();
        if (warned == 0 && run.status() == sim::Status::ok && !run.margin().stable())
            warned = run.frame;
    }
    REQUIRE(run.status() == sim::Status::diverged);
    INFO("warned at frame " << warned << ", " << run.monitor.trouble()->cause);
    REQUIRE(warned > 0);
    REQUIRE(warned < run.monitor.trouble()->frame);
    REQUIRE_THAT(run.monitor.trouble()->cause, ContainsSubstring("ks 218 600 too stiff for 30 substeps"));
}

TEST_CASE("Under the stretch limit cloth that is too stiff jitters: said with time, place and a remedy that helps") {
    sim::Description description = default_cloth();
    description.rules.limit = sim::LimitRule::cs184;
    description.cloth.ks = 225000;
    description.cloth.pinned = {{0, 0}, {49, 0}};
    Run run(description);
    REQUIRE(run.after(90) == sim::Status::jitter);
    const sim::Trouble& trouble = *run.monitor.trouble();
    INFO(trouble.cause);
    REQUIRE(trouble.frame == run.frame);
    REQUIRE(trouble.frame < 30);
    REQUIRE_THAT(trouble.time, WithinRel(static_cast<double>(trouble.frame) / 90, 1e-9));
    REQUIRE_THAT(trouble.cause, ContainsSubstring("frame " + std::to_string(trouble.frame)));
    REQUIRE_THAT(trouble.cause, ContainsSubstring("column " + std::to_string(trouble.column) + ", row " +
                                                  std::to_string(trouble.row)));
    REQUIRE_THAT(trouble.cause, ContainsSubstring("ks 225 000 too stiff for 30 substeps"));

    // It stays bounded, and is no divergence a second later.
    const std::string cause = trouble.cause;
    while (run.frame < 90)
        run.step_frame();
    REQUIRE(run.status() == sim::Status::jitter);
    REQUIRE(run.monitor.trouble()->cause == cause); // the first is kept
    REQUIRE(sim::diagnose(run.sheet.model, run.sheet.state).max_strain < 1);

    description.stepping.substeps = substeps_that_would_do(cause);
    REQUIRE(description.stepping.substeps < 35);
    REQUIRE(Run(description).after(90) == sim::Status::ok);
}

TEST_CASE("Without a stretch limit the same cloth is gone") {
    sim::Description description = default_cloth();
    description.cloth.ks = 225000;
    description.cloth.pinned = {{0, 0}, {49, 0}};
    Run run(description);
    REQUIRE(run.after(90) == sim::Status::diverged);
    INFO(run.monitor.trouble()->cause);
    description.stepping.substeps = substeps_that_would_do(run.monitor.trouble()->cause);
    REQUIRE(Run(description).after(90) == sim::Status::ok);
}

TEST_CASE("No shipped scene is in trouble, in the air, at impact or at rest") {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(checkout() / "scenes"))
        files.push_back(entry.path());
    REQUIRE(files.size() >= 10);
    for (const std::filesystem::path& file : files) {
        const auto simulation = sim::Simulation::create(scene::load_scene(file).simulation);
        simulation->watch(true);
        while (simulation->frame() < static_cast<std::uint64_t>(attempts(180)) && !simulation->trouble())
            simulation->step_frame();
        INFO(file.string() << ": " << (simulation->trouble() ? simulation->trouble()->cause : ""));
        REQUIRE_FALSE(simulation->trouble());
    }
}

TEST_CASE("However fast smooth motion is, it is no jitter") {
    sim::Description description = default_cloth();
    description.stepping.gravity = {0, -5000, 0}; // a change of 0.03 rest lengths in each step
    REQUIRE(Run(description).after(60) == sim::Status::ok);
}

TEST_CASE("Explicit Euler and Heun are told as what they are: no number of substeps would do") {
    sim::Description description = default_cloth();
    description.cloth.damping = 0;
    description.stepping.substeps = 12;
    description.stepping.integrator = GENERATE(sim::IntegratorId::explicit_euler, sim::IntegratorId::heun);
    Run run(description);
    REQUIRE(run.after(180) == sim::Status::diverged);
    REQUIRE_THAT(run.monitor.trouble()->cause, ContainsSubstring("amplifies every oscillation"));
}

TEST_CASE("Under the stretch limit explicit Euler shakes without end, which is a jitter") {
    sim::Description description = default_cloth();
    description.rules.limit = sim::LimitRule::cs184;
    description.stepping.integrator = sim::IntegratorId::explicit_euler;
    description.cloth.pinned = {{0, 0}, {49, 0}};
    REQUIRE(Run(description).after(180) == sim::Status::jitter);
}

TEST_CASE("Trouble that is not the stiffness is not blamed on it") {
    sim::Description description = default_cloth();
    description.cloth.density = -150;
    Run negative(description);
    REQUIRE(negative.after(900) == sim::Status::diverged);
    REQUIRE_THAT(negative.monitor.trouble()->cause, ContainsSubstring("density is negative"));

    description = default_cloth();
    description.cloth.pinned = {{0, 0}};
    description.stepping.gravity = {0, -1e9, 0};
    Run pulled(description);
    REQUIRE(pulled.after(90) == sim::Status::diverged);
    INFO(pulled.monitor.trouble()->cause);
    REQUIRE_THAT(pulled.monitor.trouble()->cause, ContainsSubstring("not by stiffness"));
}

TEST_CASE("A point that is no longer finite is found, and named") {
    sim::Description description = default_cloth();
    Run run(description);
    run.step_frame();
    REQUIRE(run.status() == sim::Status::ok);
    run.sheet.state.position.y[run.sheet.at(17, 31)] = std::numeric_limits<double>::quiet_NaN();
    run.monitor.end_of_frame(run.sheet.model, run.sheet.state, 2);
    REQUIRE(run.status() == sim::Status::diverged);
    REQUIRE((run.monitor.trouble()->column == 17 && run.monitor.trouble()->row == 31));
    REQUIRE_THAT(run.monitor.trouble()->cause, ContainsSubstring("no longer finite"));
    run.monitor.begin(run.sheet.state); // as after a saved state that is not finite
    run.step_frame();
    REQUIRE_THAT(run.monitor.trouble()->cause, ContainsSubstring("from the beginning"));
}

TEST_CASE("Watching a run changes no bit of it and allocates nothing, and a change or a saved state begins anew") {
    sim::Description description = default_cloth();
    description.stepping.precision = GENERATE(sim::Precision::single_precision, sim::Precision::double_precision);
    description.rules.limit = sim::LimitRule::cs184;
    const auto watched = sim::Simulation::create(description), alone = sim::Simulation::create(description);
    watched->watch(true);
    watched->step_frame();
    const std::vector<std::byte> sound = watched->save_state();
    const std::size_t before = allocations();
    for (int i = 0; i < 10; ++i)
        watched->step_frame();
    REQUIRE(allocations() == before);
    for (int i = 0; i < 11; ++i)
        alone->step_frame();
    REQUIRE(watched->hash() == alone->hash());
    REQUIRE_FALSE(watched->trouble());

    sim::Description stiff = description;
    stiff.cloth.ks = 1e9;
    for (const bool by_change : {true, false}) {
        for (sim::Simulation* simulation : {watched.get(), alone.get()}) {
            simulation->change(stiff);
            simulation->step_frame();
        }
        REQUIRE(watched->trouble());
        REQUIRE_FALSE(alone->trouble());
        sim::Snapshot snapshot;
        watched->capture(snapshot);
        REQUIRE(snapshot.trouble == watched->trouble());
        REQUIRE(snapshot.diagnostics.status == sim::Status::diverged);
        REQUIRE(snapshot.diagnostics.cause == watched->trouble()->cause);
        if (by_change)
            watched->change(description);
        else
            watched->load_state(sound);
        REQUIRE_FALSE(watched->trouble());
        watched->load_state(sound);
    }
}
