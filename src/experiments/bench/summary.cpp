#include <algorithm>
#include <initializer_list>

#include "experiments/bench/bench.h"

namespace clothlab::experiments {
namespace {

constexpr auto single_precision = sim::Precision::single_precision;
constexpr auto double_precision = sim::Precision::double_precision;

const char* name_of(sim::Precision precision) {
    return precision == single_precision ? "single" : "double";
}

std::string on_threads(int threads) {
    return threads == 1 ? "1 thread" : std::to_string(threads) + " threads";
}

class Summary {
public:
    explicit Summary(const BenchTable& table) : table_(table) {}

    const BenchGroup* group(const std::string& name, int n) const {
        for (const BenchGroup& g : table_.groups)
            if (g.name == name && g.n == n)
                return &g;
        return nullptr;
    }
    /// The run that a user gets who asks for nothing.
    const BenchRow* row(const std::string& name, int n, sim::Precision precision, int threads) const {
        const BenchGroup* g = group(name, n);
        return g ? g->find(table_.best_kernel, precision, threads) : nullptr;
    }
    /// A figure that follows from the times of these runs.
    void add(std::initializer_list<const BenchRow*> runs, BenchFigure figure) {
        figure.disturbed = std::any_of(runs.begin(), runs.end(), [](const BenchRow* run) { return run->disturbed; });
        figures_.push_back(std::move(figure));
    }

    void full_step(const std::string& name, sim::Precision precision) {
        const BenchRow* r = row(name, 50, precision, 1);
        if (!r)
            return;
        const auto add_one = [&](const char* baseline, double value, const BenchRow& to) {
            add({r, &to}, {.name = std::string("full step: ") + baseline + " to kernel, " + name + " 50 x 50, " +
                                   name_of(precision) + ", 1 thread",
                           .value = value,
                           .fastest = to.step.min / r->step.min,
                           .unit = "x",
                           .at_least = precision == single_precision ? 10 : 6,
                           .aim = precision == single_precision ? std::optional(20.0) : std::nullopt});
        };
        add_one(textbook_name, r->speedup, group(name, 50)->textbook());
        if (r->handout_speedup)
            add_one(handout_name, *r->handout_speedup, *group(name, 50)->handout());
    }
    void forces(int threads) {
        for (const char* name : {"pinned", "springs"}) {
            const BenchRow* r = row(name, 50, single_precision, threads);
            if (!r)
                continue;
            const std::string which = std::string(", ") + name + " 50 x 50, single, " + on_threads(threads);
            const double fastest = r->forces_and_verlet.min;
            add({r, &group(name, 50)->textbook()},
                {.name = "forces + Verlet: textbook to kernel" + which,
                 .value = r->forces_speedup,
                 .fastest = group(name, 50)->textbook().forces_and_verlet.min / fastest,
                 .unit = "x"});
            if (r->forces_to_full_step)
                add({r, &group("pinned", 50)->textbook()},
                    {.name = "textbook's full step to kernel's forces + Verlet" + which,
                     .value = *r->forces_to_full_step,
                     .fastest = group("pinned", 50)->textbook().step.min / fastest,
                     .unit = "x"});
            // In the pinned cloth's full step other stages, on one thread, lie between two sweeps: each time half of
            // the points have to go over to the second thread and back.
            const bool alone = std::string(name) == "springs";
            if (r->forces_to_handout)
                add({r, group("pinned", 50)->handout()},
                    {.name = "handout's full step to kernel's forces + Verlet" + which,
                     .value = *r->forces_to_handout,
                     .fastest = group("pinned", 50)->handout()->step.min / fastest,
                     .unit = "x",
                     .at_least = threads == 1            ? std::optional(60.0)
                                 : threads == 2 && alone ? std::optional(100.0)
                                                         : std::nullopt});
        }
    }
    void steps(const std::string& name, int n, int threads, bool real_time) {
        if (const BenchRow* r = row(name, n, single_precision, threads))
            add({r}, {.name = name + " " + std::to_string(n) + " x " + std::to_string(n) + ", single, " +
                              on_threads(threads),
                      .value = r->steps_per_s(),
                      .fastest = 1 / r->step.min,
                      .unit = "steps/s",
                      .at_least = real_time ? std::optional(group(name, n)->steps_per_second) : std::nullopt});
    }
    /// The sweep's share of what the machine could do if it did nothing but fused multiply-adds.
    void share_of_peak(int n, int threads) {
        if (const BenchRow* r = row("springs", n, single_precision, threads))
            add({r}, {.name = "forces + Verlet: share of the peak, springs " + std::to_string(n) + " x " +
                              std::to_string(n) + ", single, " + on_threads(threads),
                      .value = 100 * r->fma_share,
                      .fastest = 100 * r->fma_share * r->forces_and_verlet.median / r->forces_and_verlet.min,
                      .unit = "%",
                      .at_least = threads <= 2 ? std::optional(45.0) : std::nullopt});
    }
    void growth(const std::string& name, sim::Precision precision, int threads) {
        const BenchRow *small = row(name, 50, precision, threads), *large = row(name, 512, precision, threads);
        if (small && large)
            add({small, large}, {.name = "time per point: 512 x 512 to 50 x 50, " + name + ", " + name_of(precision) +
                                         ", " + on_threads(threads),
                                 .value = large->ns_per_point / small->ns_per_point,
                                 .fastest = large->step.min / (512.0 * 512.0) / (small->step.min / (50.0 * 50.0)),
                                 .unit = "x",
                                 .at_most = 1.5});
    }
    std::vector<BenchFigure> take() { return std::move(figures_); }

private:
    const BenchTable& table_;
    std::vector<BenchFigure> figures_;
};

} // namespace

std::vector<BenchFigure> summarise(const BenchTable& table) {
    std::vector<int> threads;
    for (const ThreadPeak& peak : table.machine.by_threads)
        threads.push_back(peak.threads);
    Summary summary(table);
    for (const char* name : {"falling", "pinned"})
        for (const sim::Precision precision : {single_precision, double_precision})
            summary.full_step(name, precision);
    for (const int t : threads)
        summary.forces(t);
    for (const int t : threads)
        summary.steps("falling-thick", 100, t, true);
    for (const char* name : {"falling", "pinned", "springs"})
        for (const int t : threads)
            summary.steps(name, 512, t, false);
    for (const int t : threads)
        summary.share_of_peak(512, t);
    for (const char* name : {"falling", "pinned", "springs"})
        for (const int t : threads)
            summary.growth(name, single_precision, t);
    return summary.take();
}

} // namespace clothlab::experiments
