// The bench on tiny cloths: its rows are complete and agree with each other. No time is expected of it.
#include <algorithm>
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <set>

#include "experiments/bench/bench.h"
#include "experiments/bench/cases.h"
#include "scene/io.h"
#include "sim/execution.h"
#include "support/files.h"

using namespace clothlab;
using namespace clothlab::test;
using namespace clothlab::experiments;

namespace {

BenchConfig tiny_bench(const std::string& filter = "") {
    BenchConfig config;
    config.pinned = scene::load_scene(checkout() / "scenes/two-pins.json").simulation;
    config.falling = scene::load_scene(checkout() / "scenes/self-collision.json").simulation;
    config.sizes = {8, 24};
    config.threads = {1, 2};
    config.filter = filter;
    config.quick = true;
    return config;
}

void require_consistent(const Measured& m) {
    REQUIRE(m.min >= 0);
    REQUIRE(m.min <= m.median);
    REQUIRE(m.median <= m.max);
}

void require_consistent(const BenchGroup& group, const BenchRow& row) {
    INFO(group.name << " " << group.n << " " << row.kernel << " " << row.threads);
    REQUIRE(row.rounds >= 3);
    REQUIRE(row.alone <= row.rounds);
    REQUIRE(row.disturbed == (row.alone < 1));
    REQUIRE(row.steps >= 3);
    require_consistent(row.step);
    require_consistent(row.forces_and_verlet);
    double fastest_stages = 0;
    for (const Measured& stage : row.stages) {
        require_consistent(stage);
        fastest_stages += stage.min;
    }
    REQUIRE(row.forces_and_verlet.min > 0);
    REQUIRE(fastest_stages <= row.step.min); // holds in every round, so for the minima
    REQUIRE(row.speedup > 0);
    REQUIRE(row.forces_speedup > 0);
    REQUIRE(row.forces_to_full_step);
    REQUIRE(*row.forces_to_full_step > 0);
    REQUIRE(row.ns_per_point > 0);
    REQUIRE(row.springs_per_s > 0);
    REQUIRE(row.fma_share > 0);
    REQUIRE(row.bandwidth_share > 0);
    REQUIRE((row.bandwidth_level == "L1" || (group.n > 8 && row.bandwidth_level == "L2")));
    REQUIRE(row.bytes_per_point > 6 * sizeof(float));
}

void require_same_steps(const BenchRow& textbook, const BenchRow& row) {
    if (row.precision != textbook.precision || row.steps != textbook.steps)
        return;
    INFO(row.kernel << " " << row.threads);
    REQUIRE(row.self_contacts == textbook.self_contacts);
    REQUIRE(row.contacts == textbook.contacts);
    REQUIRE(row.shortened_springs == textbook.shortened_springs);
}

} // namespace

TEST_CASE(
    "The bench times every kernel that this machine has, in every case and size, beside the textbook, and all do the "
    "same steps",
    "[threads]") {
    BenchConfig config = tiny_bench();
    std::vector<std::string> said;
    config.progress = [&](const std::string& what) { said.push_back(what); };
    const BenchTable table = run_bench(config);
    REQUIRE(table.groups.size() == 6);
    REQUIRE(said.size() == 7); // the machine and each group
    REQUIRE(table.machine.with(2).threads == 2);
    for (const BenchGroup& group : table.groups) {
        const auto n = static_cast<std::size_t>(group.n);
        REQUIRE(group.points == n * n);
        REQUIRE(group.springs == 2 * n * (n - 1) + 2 * (n - 1) * (n - 1) + 2 * n * (n - 2));
        REQUIRE(group.rows.front().kernel == textbook_name);
        REQUIRE(group.textbook().speedup == 1);
        std::set<std::string> kernels;
        for (const BenchRow& row : group.rows) {
            kernels.insert(row.kernel);
            require_consistent(group, row);
            require_same_steps(group.textbook(), row);
            REQUIRE(row.handout_speedup.has_value() == (group.name != "springs"));
            REQUIRE(row.forces_to_handout > 0.0);
        }
        REQUIRE(kernels.count(handout_name) == (group.name == "springs" ? 0u : 1u)); // it would be the textbook's
        REQUIRE((!group.handout() || group.handout()->handout_speedup == 1.0));
        REQUIRE((group.textbook().self_contacts > 0) == (group.name == "falling" && n == 24));
        for (const sim::InstructionSet set :
             {sim::InstructionSet::scalar, sim::InstructionSet::avx2, sim::InstructionSet::avx512}) {
            const std::string name(sim::instruction_sets()[static_cast<std::size_t>(set)].name);
            REQUIRE(kernels.count(name) == (sim::is_supported(set) ? 1u : 0u));
        }
        for (const sim::Precision precision : {sim::Precision::single_precision, sim::Precision::double_precision}) {
            REQUIRE(group.find(table.best_kernel, precision, 1));
            REQUIRE_FALSE(group.find(table.best_kernel, precision, 3));
        }
    }
    REQUIRE(table.summary.empty()); // it is about other sizes
}

TEST_CASE("A filter leaves the runs it matches, and the textbook's and the handout's to compare them with",
          "[threads]") {
    const auto on_one_thread = [](const std::string& filter) {
        BenchConfig config = tiny_bench(filter);
        config.threads = {1};
        return run_bench(config);
    };
    const BenchTable table = on_one_thread("^(springs|falling)/8/single/scalar");
    REQUIRE(table.groups.size() == 2);
    for (const BenchGroup& group : table.groups) {
        REQUIRE(group.n == 8);
        REQUIRE(group.name != "pinned");
        REQUIRE(group.rows.size() == (group.name == "springs" ? 2 : 3));
        REQUIRE(group.rows.back().kernel == "scalar");
        REQUIRE(group.rows.back().precision == sim::Precision::single_precision);
        REQUIRE_FALSE(group.rows.back().forces_to_full_step); // without the pinned case
        REQUIRE_FALSE(group.rows.back().forces_to_handout);
    }
    const BenchTable handouts = on_one_thread("24/.*handout");
    REQUIRE(handouts.groups.size() == 2); // those with self-collision
    for (const BenchGroup& group : handouts.groups)
        REQUIRE(group.rows.size() == 2);
    REQUIRE_THROWS_AS(on_one_thread("("), BenchFilterError);
    REQUIRE_THROWS_AS(on_one_thread("velvet"), BenchFilterError);
}

TEST_CASE("Cases keep the mass of a point, shrink the thickness with the distance of points and move the pins along") {
    BenchConfig config = tiny_bench();
    config.sizes = {25, 100};
    const std::vector<BenchCase> cases = bench_cases(config);
    REQUIRE(cases.size() == 7);
    for (const BenchCase& c : cases) {
        const sim::Description& original = c.name.rfind("falling", 0) == 0 ? config.falling : config.pinned;
        const double finer = c.description.cloth.num_width_points / 50.0;
        const bool as_it_is = c.name == "falling-thick";
        const double mass = sim::point_mass(original.cloth) / (as_it_is ? finer * finer : 1);
        REQUIRE(std::abs(sim::point_mass(c.description.cloth) / mass - 1) < 1e-12);
        const double thickness = original.cloth.thickness / (as_it_is ? 1 : finer);
        REQUIRE(std::abs(c.description.cloth.thickness / thickness - 1) < 1e-12);
        REQUIRE(c.frames > 0);
        for (const sim::GridPoint& pin : c.description.cloth.pinned)
            REQUIRE((pin[0] == 0 || pin[0] == c.description.cloth.num_width_points - 1));
    }
}

TEST_CASE("The summary has the figures that the rows allow") {
    const auto table_of = [](std::initializer_list<int> sizes) {
        BenchTable table;
        table.best_kernel = "best";
        table.machine.by_threads = {ThreadPeak{.threads = 1}};
        for (const int n : sizes) {
            BenchGroup group;
            group.name = "falling";
            group.n = n;
            group.rows.resize(2);
            group.rows[0].kernel = textbook_name;
            group.rows[1].kernel = "best";
            group.rows[1].precision = sim::Precision::single_precision;
            group.rows[1].speedup = 12;
            group.rows[0].step.min = 8e-3;
            group.rows[1].step = {.median = 1e-3, .min = 0.5e-3};
            group.rows[1].ns_per_point = n;
            table.groups.push_back(group);
        }
        return table;
    };
    REQUIRE(summarise(table_of({8})).empty());
    const std::vector<BenchFigure> one = summarise(table_of({50}));
    REQUIRE(one.size() == 1);
    REQUIRE(one.front().value == 12);
    REQUIRE(one.front().fastest == 16);
    REQUIRE(one.front().at_least == 10.0);
    const std::vector<BenchFigure> both = summarise(table_of({50, 512}));
    REQUIRE(both.size() == 3);
    REQUIRE(both[1].value == 1000);
    REQUIRE(both[1].fastest == 2000);
    REQUIRE(both[1].unit == "steps/s");
    REQUIRE(both[2].value == 512 / 50.0);
    REQUIRE(both[2].at_most == 1.5);

    BenchTable pinned = table_of({50});
    pinned.groups.front().name = "pinned";
    BenchRow handout;
    handout.kernel = handout_name;
    handout.step.min = 10e-3;
    pinned.groups.front().rows.push_back(handout);
    BenchRow& best = pinned.groups.front().rows[1];
    best.forces_and_verlet.min = 0.1e-3;
    best.handout_speedup = 13;
    best.forces_to_handout = 70;
    const std::vector<BenchFigure> compared = summarise(pinned);
    REQUIRE(compared.size() == 4); // two full steps; forces and Verlet against the textbook's, and the handout's step
    REQUIRE(compared[1].value == 13);
    REQUIRE(compared[1].fastest == 20);
    REQUIRE(compared[3].value == 70);
    REQUIRE(std::abs(compared[3].fastest - 100) < 1e-9);
    REQUIRE(compared[3].at_least == 60.0);
}
