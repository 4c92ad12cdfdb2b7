#include "experiments/sweep/cell.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "experiments/findings.h"
#include "experiments/trial.h"
#include "scene/frames.h"
#include "scene/number_text.h"
#include "sim/intersections.h"
#include "sim/simulation.h"

namespace clothlab::experiments {
namespace {

/// Contacts over a run.
struct Contacts {
    std::optional<double> first, first_with_itself; ///< s
    sim::StepCounts last;                           ///< of the last step

    void count(const sim::StepCounts& counts, double time) {
        last = counts;
        if (counts.contacts > 0 && !first)
            first = time;
        if (counts.self_contacts > 0 && !first_with_itself)
            first_with_itself = time;
    }
};

/// What is nothing stays empty.
class Row {
public:
    void add(double number) { values_.emplace_back(number); }
    void add(std::size_t count) { add(static_cast<double>(count)); }
    void add(const std::optional<double>& number) {
        values_.emplace_back();
        if (number)
            values_.back() = *number;
    }
    void add(const std::string& text) {
        values_.emplace_back();
        if (!text.empty())
            values_.back() = text;
    }
    std::vector<Value> take() { return std::move(values_); }

private:
    std::vector<Value> values_;
};

} // namespace

std::uint64_t frames_of(const SweepLength& length, const sim::Description& description) {
    if (!length.seconds)
        return length.frames;
    return scene::frames_of(*length.seconds, description);
}

std::vector<Column> cell_columns(bool times) {
    std::vector<Column> columns{{"status", "Status"},
                                {"time_s", "Time (s)"},
                                {"steps", "Steps", 9},
                                {"kinetic_J", "Kinetic (J)"},
                                {"spring_J", "Spring (J)"},
                                {"gravity_J", "Gravity (J)"},
                                {"total_J", "Total (J)"},
                                {"max_strain", "Max strain"},
                                {"rms_speed_m_s", "RMS speed (m/s)"},
                                {"drape_height_m", "Drape height (m)"},
                                {"mean_height_m", "Mean height (m)"},
                                {"first_contact_s", "First contact (s)"},
                                {"contacts", "Contacts", 9},
                                {"first_self_contact_s", "First self-contact (s)"},
                                {"self_contacts", "Self-contacts", 9},
                                {"intersections", "Intersections", 9}};
    if (times)
        columns.insert(columns.end(), {{"wall_s", "Wall time (s)"}, {"steps_per_s", "Steps/s"}});
    columns.insert(columns.end(), {{"hash", "Hash"}, {"cause", "Cause"}});
    return columns;
}

std::vector<Value> run_cell(const sim::Description& description, std::uint64_t frames, bool times,
                            const std::function<bool(double share)>& go_on) {
    using Clock = std::chrono::steady_clock;
    const auto simulation = sim::Simulation::create(description);
    simulation->watch(true);
    Contacts contacts;
    Clock::duration wall{};
    for (std::uint64_t frame = 0; frame < frames; ++frame) {
        const auto begin = Clock::now();
        while (simulation->frame() == frame) {
            const sim::StepCounts counts = simulation->step();
            contacts.count(counts, simulation->time());
        }
        wall += Clock::now() - begin;
        if (simulation->trouble() && simulation->trouble()->status == sim::Status::diverged)
            break;
        if (go_on && !go_on(static_cast<double>(frame + 1) / static_cast<double>(frames)))
            throw Cancelled();
    }

    sim::Snapshot snapshot;
    simulation->capture(snapshot);
    const sim::Diagnostics& d = snapshot.diagnostics;
    const Shape shape = shape_of(*simulation);
    Row row;
    row.add(std::string(sim::status_names[static_cast<std::size_t>(d.status)]));
    row.add(simulation->time());
    row.add(simulation->steps());
    row.add(d.energy.kinetic);
    row.add(d.energy.spring);
    row.add(d.energy.gravity);
    row.add(d.energy.total());
    row.add(d.max_strain);
    row.add(d.rms_speed);
    row.add(drape_height(shape));
    row.add(mean_height(shape));
    row.add(contacts.first);
    row.add(contacts.last.contacts);
    row.add(contacts.first_with_itself);
    row.add(contacts.last.self_contacts);
    // Of a tangle there is no end of intersections to count, and no sense in it.
    if (d.status == sim::Status::ok)
        row.add(sim::count_intersections(snapshot.columns, snapshot.rows, snapshot.positions));
    else
        row.add(std::optional<double>());
    if (times) {
        const double seconds = std::chrono::duration<double>(wall).count();
        row.add(seconds);
        row.add(seconds > 0 ? std::optional(static_cast<double>(simulation->steps()) / seconds) : std::nullopt);
    }
    row.add(scene::hash_text(simulation->hash()));
    row.add(d.cause);
    return row.take();
}

} // namespace clothlab::experiments
