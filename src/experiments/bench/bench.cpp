#include "experiments/bench/bench.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <regex>

#include "experiments/bench/cases.h"
#include "experiments/bench/contestant.h"
#include "experiments/bench/core_witness.h"
#include "experiments/bench/textbook.h"
#include "sim/execution.h"

namespace clothlab::experiments {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Floating-point operations of a spring: three differences, a length (3 products, 2 sums, a root), a scale
/// (difference, product, quotient), three products with it and a sum and a difference per axis for its two ends. Root
/// and quotient count as one each, though it is they that limit the kernels: a processor starts a vector of fused
/// multiply-adds twice a cycle, one of roots every 5 to 20.
constexpr double spring_operations = 3 + 6 + 3 + 3 + 6;
/// Of a point's Verlet step: x + keep (x - p) + f c per axis.
constexpr double verlet_operations = 3 * 5;
/// Coordinates that this has to move: position and previous position read, next position written.
constexpr double coordinates_moved = 9;
/// Those that lie in memory, the next position in place of the previous.
constexpr double coordinates_held = 6;

/// How long a contestant may take in a round, s; those that remember nothing take fewer steps then.
constexpr double slot = 0.25;
/// How long a contestant warms up before its turn, s.
constexpr double warm_up = 1e-3;
constexpr int least_steps = 3;

struct Run {
    BenchRow row;
    std::unique_ptr<Contestant> contestant;
    std::vector<double> cores;                   ///< of each round: the worse of what the witness saw before and after
    std::vector<double> step, forces_and_verlet; ///< s, of each round
    std::array<std::vector<double>, sim::stage_count> stages;
};

class Filter {
public:
    explicit Filter(const std::string& text) : text_(text) {
        try {
            expression_ = std::regex(text);
        } catch (const std::regex_error& e) {
            throw BenchFilterError("'" + text + "' is no regular expression: " + e.what());
        }
    }
    bool wants(const std::string& case_name, int n, const BenchRow& row) const {
        return std::regex_search(case_name + "/" + std::to_string(n) + "/" +
                                     (row.precision == sim::Precision::single_precision ? "single" : "double") + "/" +
                                     row.kernel + "/" + std::to_string(row.threads),
                                 expression_);
    }
    bool names(const std::string& word) const { return text_.find(word) != std::string::npos; }

private:
    std::string text_;
    std::regex expression_;
};

/// Steps in a round: enough to see what the runs that remember do now and then, fewer where a step takes long. The
/// first, in which they find anew all that they remember, counts.
int steps_of_round(std::size_t points, bool quick) {
    constexpr std::size_t least = 16, most = 128, in_total = std::size_t{1} << 23;
    return static_cast<int>(std::clamp(in_total / points, least, quick ? 2 * least : most));
}

/// Takes steps until caches, branch predictors and clock have seen that there is work. Returns the seconds of one.
double warmed_up(Contestant& contestant) {
    const Clock::time_point start = Clock::now();
    for (int steps = 0, next = 1;; next = std::min(2 * next, 32)) {
        contestant.advance(next);
        steps += next;
        if (const double seconds = seconds_since(start); seconds > warm_up)
            return seconds / steps;
    }
}

/// One contestant's turn in a round.
void take_turn(Run& run, const Moment& moment, int steps, double points, CoreWitness& witness) {
    Contestant& contestant = *run.contestant;
    const double cores_before = witness.ask(run.row.threads);
    contestant.start_from(moment);
    const double warm_step = warmed_up(contestant);
    if (run.row.steps > 0)
        steps = run.row.steps; // as in the first round
    else if (!contestant.remembers())
        steps = static_cast<int>(std::clamp(slot / warm_step, static_cast<double>(least_steps), 1.0 * steps));
    contestant.start_from(moment);
    contestant.time_stages();
    const Clock::time_point start = Clock::now();
    const sim::StepCounts sum = contestant.advance(steps);
    run.step.push_back(seconds_since(start) / steps);
    run.cores.push_back(std::min(cores_before, witness.ask(run.row.threads)));
    const auto stage = [&](sim::Stage s) { return contestant.stage_seconds()[static_cast<std::size_t>(s)] / steps; };
    run.forces_and_verlet.push_back(stage(sim::Stage::forces) + stage(sim::Stage::integrate));
    for (std::size_t i = 0; i < run.stages.size(); ++i)
        run.stages[i].push_back(stage(static_cast<sim::Stage>(i)));
    run.row.steps = steps;
    run.row.self_contacts = static_cast<double>(sum.self_contacts) / steps / points;
    run.row.contacts = static_cast<double>(sum.contacts) / steps / points;
    run.row.shortened_springs = static_cast<double>(sum.shortened_springs) / steps / points;
}

/// All cases have their turn in each pass, so that those that are compared with each other were timed at the same
/// times: what else a machine does can go on for longer than a case takes.
int passes(bool quick) {
    return quick ? 1 : 3;
}

/// Of which rounds, from the first on, no thread shared its core.
std::vector<std::size_t> rounds_alone(const Run& run, const CoreWitness& witness, std::size_t first = 0) {
    std::vector<std::size_t> alone;
    for (std::size_t round = first; round < run.cores.size(); ++round)
        if (witness.alone(run.cores[round], run.row.threads))
            alone.push_back(round);
    return alone;
}

/// The rounds of a pass: until the time is used up, an odd number of them. Then runs that were alone on their cores in
/// fewer than two have more turns, as many as there is time for in a slot.
void take_rounds(std::vector<Run>& runs, const Moment& moment, int steps, double points, bool quick,
                 CoreWitness& witness) {
    const double budget = quick ? 0.5 : 1; // s
    const int least = quick ? 3 : 1, most = 5;
    const Clock::time_point start = Clock::now();
    int rounds = 0;
    for (; rounds < most && (rounds < least || rounds % 2 == 0 || seconds_since(start) < budget); ++rounds)
        for (Run& run : runs)
            take_turn(run, moment, steps, points, witness);
    for (Run& run : runs) {
        const std::size_t first = run.cores.size() - static_cast<std::size_t>(rounds);
        const Clock::time_point more = Clock::now();
        for (double turn = 0; rounds_alone(run, witness, first).size() < 2 && seconds_since(more) + turn < slot;) {
            const Clock::time_point its_start = Clock::now();
            take_turn(run, moment, steps, points, witness);
            turn = seconds_since(its_start);
        }
    }
}

/// The runs of a case that the filter wants, after the textbook's and the handout's; none at all where it wants
/// nothing.
std::vector<Run> wanted_runs(const BenchCase& which, const BenchConfig& config, const Filter& filter) {
    const int n = which.description.cloth.num_width_points;
    const bool collides = which.description.rules.self_collision == sim::SelfCollisionRule::cs184;
    std::vector<Run> runs(collides ? 2 : 1);
    runs.front().row.kernel = textbook_name;
    if (collides)
        runs.back().row.kernel = handout_name;
    bool wanted =
        std::any_of(runs.begin(), runs.end(), [&](const Run& run) { return filter.wants(which.name, n, run.row); });
    for (const sim::Precision precision : {sim::Precision::double_precision, sim::Precision::single_precision}) {
        for (const sim::InstructionSetInfo& set : sim::instruction_sets()) {
            if (set.id == sim::InstructionSet::automatic || !sim::is_supported(set.id))
                continue;
            if (set.id == sim::InstructionSet::vec128 && sim::is_supported(sim::InstructionSet::avx2) &&
                !filter.names(std::string(set.name)))
                continue;
            for (const int threads : config.threads) {
                if (set.id == sim::InstructionSet::scalar && threads > 1)
                    continue; // the plain loops use one
                Run run;
                run.row.kernel = set.name;
                run.row.precision = precision;
                run.row.threads = threads;
                if (filter.wants(which.name, n, run.row)) {
                    wanted = true;
                    runs.push_back(std::move(run));
                }
            }
        }
    }
    if (!wanted)
        runs.clear();
    return runs;
}

void create_contestants(std::vector<Run>& runs, const sim::Description& description) {
    for (Run& run : runs) {
        if (run.row.kernel == textbook_name || run.row.kernel == handout_name) {
            run.contestant = make_textbook_contestant(description, run.row.kernel == handout_name ? CellMap::handout
                                                                                                  : CellMap::fast);
            continue;
        }
        sim::Execution execution{.threads = run.row.threads, .fewer_if_faster = false};
        for (const sim::InstructionSetInfo& set : sim::instruction_sets())
            if (set.name == run.row.kernel)
                execution.instructions = set.id;
        run.contestant = make_contestant(description, run.row.precision, execution);
    }
}

double points_per_cell(const sim::Description& description, const Moment& moment) {
    Textbook textbook(description);
    textbook.place(moment.position, moment.last);
    return textbook.points_per_cell();
}

/// A case of which something is wanted.
struct WantedCase {
    const BenchCase* which;
    std::vector<Run> runs;
    BenchGroup group;
    Moment moment; ///< empty before the first pass
};

void begin(WantedCase& wanted) {
    const sim::Description& description = wanted.which->description;
    BenchGroup& group = wanted.group;
    group.name = wanted.which->name;
    group.n = description.cloth.num_width_points;
    group.frames = wanted.which->frames;
    group.steps_per_second = 1 / sim::step_length(description);
    const bool single = std::any_of(wanted.runs.begin(), wanted.runs.end(), [](const Run& run) {
        return run.row.precision == sim::Precision::single_precision;
    });
    wanted.moment = advance(description, std::max(group.frames * description.stepping.substeps, 1), single);
    group.points = wanted.moment.position.size();
    group.springs = Textbook(description).springs();
    group.points_per_cell = points_per_cell(description, wanted.moment);
}

void take_pass(WantedCase& wanted, bool quick, CoreWitness& witness) {
    create_contestants(wanted.runs, wanted.which->description);
    const auto points = static_cast<double>(wanted.group.points);
    take_rounds(wanted.runs, wanted.moment, steps_of_round(wanted.group.points, quick), points, quick, witness);
    for (Run& run : wanted.runs) {
        run.row.bytes_per_point = static_cast<double>(run.contestant->memory_bytes()) / points;
        run.contestant.reset(); // all cases' at once would not fit into every memory
    }
}

/// The rounds in which the witness saw the most work done.
std::vector<std::size_t> least_disturbed(const std::vector<double>& cores, std::size_t count) {
    std::vector<std::size_t> rounds(cores.size());
    std::iota(rounds.begin(), rounds.end(), std::size_t{0});
    std::stable_sort(rounds.begin(), rounds.end(),
                     [&](std::size_t one, std::size_t other) { return cores[one] > cores[other]; });
    rounds.resize(count);
    return rounds;
}

void finish(WantedCase& wanted, bool quick, const CoreWitness& witness) {
    for (Run& run : wanted.runs) {
        BenchRow& row = run.row;
        std::vector<std::size_t> counting = rounds_alone(run, witness);
        row.rounds = static_cast<int>(run.step.size());
        row.alone = static_cast<int>(counting.size());
        const auto enough = static_cast<std::size_t>(std::min(passes(quick), row.rounds));
        row.disturbed = counting.size() < enough;
        if (row.disturbed)
            counting = least_disturbed(run.cores, enough);
        const auto of_rounds = [&](const std::vector<double>& values) {
            std::vector<double> counted;
            for (const std::size_t round : counting)
                counted.push_back(values[round]);
            return measured(counted);
        };
        row.step = of_rounds(run.step);
        row.forces_and_verlet = of_rounds(run.forces_and_verlet);
        for (std::size_t i = 0; i < row.stages.size(); ++i)
            row.stages[i] = of_rounds(run.stages[i]);
        wanted.group.rows.push_back(row);
    }
}

/// What follows from the measured times.
void derive(BenchGroup& group, const MachinePeak& machine, const sim::Description& description,
            const BenchGroup* pinned) {
    const auto points = static_cast<double>(group.points), springs = static_cast<double>(group.springs);
    // The springs of cloth that lies all have one of a few lengths; of cloth that stands, each has its own.
    const double rest_lengths = description.cloth.orientation == sim::Orientation::vertical ? springs : 0;
    for (BenchRow& row : group.rows) {
        const double seconds = row.forces_and_verlet.median;
        const bool single = row.precision == sim::Precision::single_precision;
        const double real = single ? sizeof(float) : sizeof(double);
        const ThreadPeak& peak = machine.with(row.threads);
        row.speedup = group.textbook().step.median / row.step.median;
        row.forces_speedup = group.textbook().forces_and_verlet.median / seconds;
        if (const BenchRow* handout = group.handout())
            row.handout_speedup = handout->step.median / row.step.median;
        if (pinned) {
            row.forces_to_full_step = pinned->textbook().step.median / seconds;
            if (const BenchRow* handout = pinned->handout())
                row.forces_to_handout = handout->step.median / seconds;
        }
        row.ns_per_point = row.step.median * 1e9 / points;
        row.springs_per_s = springs / seconds;
        if (machine.clock_ghz > 0)
            row.cycles_per_spring = seconds * machine.clock_ghz * 1e9 / springs;
        const double operations = springs * spring_operations + points * verlet_operations;
        row.fma_share = operations / seconds / ((single ? peak.single_gflops : peak.double_gflops) * 1e9);
        const double held = (points * coordinates_held + rest_lengths) * real;
        const double moved = (points * coordinates_moved + rest_lengths) * real;
        const std::size_t level = machine.level_of(static_cast<std::size_t>(held), row.threads);
        row.bandwidth_level = machine.levels[level].name;
        row.bandwidth_share = moved / seconds / (peak.bandwidth[level] * 1e9);
    }
}

} // namespace

const BenchRow* BenchGroup::find(const std::string& kernel, sim::Precision precision, int threads) const {
    for (const BenchRow& row : rows)
        if (row.kernel == kernel && row.precision == precision && row.threads == threads)
            return &row;
    return nullptr;
}

BenchTable run_bench(const BenchConfig& config) {
    const Filter filter(config.filter);
    const std::vector<BenchCase> cases = bench_cases(config);
    std::vector<WantedCase> wanted;
    for (const BenchCase& which : cases)
        if (std::vector<Run> runs = wanted_runs(which, config, filter); !runs.empty())
            wanted.push_back({&which, std::move(runs), {}, {}});
    if (wanted.empty())
        throw BenchFilterError("'" + config.filter + "' matches no run; names are like falling/50/single/avx2/1");

    const auto report = [&](const std::string& what) {
        if (config.progress)
            config.progress(what);
    };
    BenchTable table;
    report("measuring the machine");
    std::vector<int> threads = config.threads;
    threads.push_back(1); // the textbook's
    std::sort(threads.begin(), threads.end());
    threads.erase(std::unique(threads.begin(), threads.end()), threads.end());
    table.machine = measure_machine(threads);
    CoreWitness witness;
    for (const int count : threads)
        for (int n = 0; n < 8; ++n)
            witness.ask(count); // so that it has seen the best
    const sim::InstructionSet best = sim::resolve(sim::InstructionSet::automatic);
    for (const sim::InstructionSetInfo& set : sim::instruction_sets())
        if (set.id == best)
            table.best_kernel = set.name;

    const std::size_t turns = wanted.size() * static_cast<std::size_t>(passes(config.quick));
    std::size_t turn = 0;
    for (int pass = 0; pass < passes(config.quick); ++pass) {
        for (WantedCase& one : wanted) {
            const std::string n = std::to_string(one.which->description.cloth.num_width_points);
            report(one.which->name + " " + n + " x " + n + ", " + std::to_string(++turn) + " of " +
                   std::to_string(turns));
            if (pass == 0)
                begin(one);
            take_pass(one, config.quick, witness);
        }
        if (!config.quick) {
            report("measuring the machine once more");
            table.machine = best_of(table.machine, measure_machine(threads));
        }
    }
    for (WantedCase& one : wanted) {
        finish(one, config.quick, witness);
        table.groups.push_back(std::move(one.group));
    }
    for (std::size_t i = 0; i < table.groups.size(); ++i) {
        const BenchGroup* pinned = nullptr;
        for (const BenchGroup& other : table.groups)
            if (other.name == "pinned" && other.n == table.groups[i].n)
                pinned = &other;
        derive(table.groups[i], table.machine, wanted[i].which->description, pinned);
    }
    table.summary = summarise(table);
    return table;
}

} // namespace clothlab::experiments
