#include "sim/simulation.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <stdexcept>
#include <string>

#include "sim/integrators/integrator.h"
#include "sim/saved_state.h"
#include "sim/step_recorder.h"

namespace clothlab::sim {
namespace {

template <class T>
void append(std::vector<std::byte>& bytes, const T* values, std::size_t count) {
    const std::size_t end = bytes.size();
    bytes.resize(end + count * sizeof(T));
    std::memcpy(bytes.data() + end, values, count * sizeof(T));
}

/// Of all runs, in whatever thread.
std::atomic<std::uint64_t> captures = 0;

template <class Real>
class SimulationOf final : public Simulation {
public:
    SimulationOf(const Description& description, const Execution& execution)
        : Simulation(description),
          model_(make_model<Real>(description, std::make_shared<const Grid<Real>>(make_grid<Real>(description)))),
          state_(initial_state<Real>(description)), work_(make_workspace(model_, execution)) {
        begin(model_, state_, work_);
    }

    void change(const Description& description) override {
        if (!can_change_live(description_, description))
            throw std::invalid_argument("this change of grid, start or precision needs a restart");
        Model<Real> model = make_model<Real>(description, model_.grid);
        const double dt = model_.dt;
        model_ = std::move(model);
        description_ = description;
        prepare(model_, work_);
        if (dt != model_.dt) // what lies further back was not a step like the next ones
            state_.history = 0;
        if (state_.steps == 0) {
            state_ = initial_state<Real>(description);
            begin(model_, state_, work_);
        } else {
            adopt(model_, state_, work_, dt);
        }
        if (watched_)
            monitor_.begin(state_);
        if (substep_ >= model_.substeps) { // the frame under way has fewer steps now and is over
            substep_ = 0;
            ++frame_;
        }
    }

    StepCounts step() override {
        if (watched_ && substep_ + 1 >= model_.substeps)
            monitor_.before_last_step(state_);
        counts_ = sim::step(model_, state_, work_);
        count_step();
        if (watched_ && substep_ == 0)
            monitor_.end_of_frame(model_, state_, frame_);
        return counts_;
    }

    StepCounts advance(int steps) override {
        StepCounts sum;
        while (steps > 0) {
            const int together = std::min(steps, steps_together());
            if (together < least_slab_steps) {
                sum += step();
                --steps;
                continue;
            }
            step_in_slabs(model_, state_, work_, together);
            counts_ = {.force_evaluations = 1};
            for (int i = 0; i < together; ++i) {
                sum += counts_;
                count_step();
            }
            steps -= together;
        }
        return sum;
    }

    StepTrace trace_step() const override {
        StepTrace trace;
        StepRecorder<Real> recorder(trace);
        State<Real> state = state_;
        Workspace<Real> work = make_workspace(model_, {.instructions = work_.instructions});
        work.arrays = work_.arrays; // with the forces that the step would not compute again
        work.force_of_step = work_.force_of_step;
        work.solver = work_.solver; // a matrix of 40 000 points takes a second to factor
        sim::step(model_, state, work, &recorder);
        return trace;
    }

    void watch(bool on) override {
        watched_ = on;
        monitor_ = {};
        if (on)
            monitor_.begin(state_);
    }
    const std::optional<Trouble>& trouble() const override { return monitor_.trouble(); }

    double time() const override { return state_.time; }
    std::uint64_t steps() const override { return state_.steps; }
    std::size_t points() const override { return state_.position.size(); }
    Vec3 position(std::size_t i) const override {
        return {static_cast<double>(state_.position.x[i]), static_cast<double>(state_.position.y[i]),
                static_cast<double>(state_.position.z[i])};
    }
    Diagnostics diagnose() const override { return sim::diagnose(model_, state_); }
    Momentum momentum() const override { return sim::momentum(model_, state_); }
    std::uint64_t hash() const override { return sim::hash(state_); }

    StabilityMargin stability() const override { return stability_margin(model_, state_); }

    using Simulation::capture;
    void capture(Snapshot& s, const SnapshotExtras& extras) const override {
        s.capture = ++captures;
        s.columns = model_.grid->columns;
        s.rows = model_.grid->rows;
        s.positions.resize(3 * points());
        for (std::size_t i = 0; i < points(); ++i) {
            s.positions[3 * i] = static_cast<float>(state_.position.x[i]);
            s.positions[3 * i + 1] = static_cast<float>(state_.position.y[i]);
            s.positions[3 * i + 2] = static_cast<float>(state_.position.z[i]);
        }
        s.quantity_kind = extras.quantity;
        point_quantity(extras.quantity, model_, state_, s.positions, s.quantity);
        s.second_quantity_kind = extras.second_quantity;
        point_quantity(extras.second_quantity, model_, state_, s.positions, s.second_quantity);
        s.time = state_.time;
        s.steps = state_.steps;
        s.frame = frame_;
        s.substep = substep_;
        s.substeps = model_.substeps;
        s.dt = model_.dt;
        s.diagnostics = diagnose();
        s.trouble = trouble();
        if (s.trouble) {
            s.diagnostics.status = s.trouble->status;
            s.diagnostics.cause = s.trouble->cause;
        }
        s.stability = extras.stability ? std::optional(stability()) : std::nullopt;
        s.counts = counts_;
        s.instructions = instructions();
        s.threads = threads();
    }

    InstructionSet instructions() const override { return work_.instructions; }
    int threads() const override { return work_.choice.threads(); }
    std::size_t memory_bytes() const override {
        std::size_t bytes = state_.position.bytes() + state_.previous.bytes() + state_.velocity.bytes() +
                            state_.previous_velocity.bytes() + sim::memory_bytes(work_) + monitor_.bytes() +
                            model_.pinned.capacity() + model_.pins.capacity() * sizeof(model_.pins[0]);
        for (const AlignedVector<Real>& rest : model_.grid->rest)
            bytes += rest.capacity() * sizeof(Real);
        return bytes;
    }

    void time_stages(bool on) override {
        work_.timed = on;
        work_.seconds = {};
    }
    const StageSeconds& stage_seconds() const override { return work_.seconds; }

    std::vector<std::byte> save_state() const override {
        StateHeader header;
        header.real_size = sizeof(Real);
        header.columns = model_.grid->columns;
        header.rows = model_.grid->rows;
        header.substep = substep_;
        header.frame = frame_;
        header.steps = state_.steps;
        header.time = state_.time;
        header.dt = model_.dt;
        header.solver_step = state_.solver_step;
        header.history = state_.history;
        header.velocities = velocities(state_);
        std::vector<std::byte> bytes;
        append(bytes, &header, 1);
        for (const AlignedVector<Real>* axis : axes(state_))
            append(bytes, axis->data(), axis->size());
        const std::uint64_t sum = checksum(bytes);
        append(bytes, &sum, 1);
        return bytes;
    }

    void load_state(std::span<const std::byte> bytes) override {
        const StateHeader header = read_state_header(bytes);
        if (header.real_size != sizeof(Real))
            throw std::invalid_argument(std::string("a state in ") + (header.real_size == 8 ? "double" : "single") +
                                        " precision; the scene asks for " + (sizeof(Real) == 8 ? "double" : "single"));
        if (header.columns != model_.grid->columns || header.rows != model_.grid->rows)
            throw std::invalid_argument("a state of " + std::to_string(header.columns) + " x " +
                                        std::to_string(header.rows) + " points; the scene has " +
                                        std::to_string(model_.grid->columns) + " x " +
                                        std::to_string(model_.grid->rows));
        check_state(header, bytes);

        state_.velocity.resize(header.velocities > 0 ? points() : 0);
        state_.previous_velocity.resize(header.velocities > 1 ? points() : 0);
        const std::byte* from = bytes.data() + sizeof header;
        for (AlignedVector<Real>* axis : axes(state_)) {
            std::memcpy(axis->data(), from, axis->size() * sizeof(Real));
            from += axis->size() * sizeof(Real);
        }
        state_.time = header.time;
        state_.steps = header.steps;
        frame_ = header.frame;
        substep_ = header.substep < model_.substeps ? header.substep : 0;
        state_.history = header.history;
        state_.solver_step = header.solver_step;
        work_.force_of_step = 0;
        adopt(model_, state_, work_, header.dt);
        if (watched_)
            monitor_.begin(state_);
    }

private:
    /// How many steps can be taken in slabs now; those that are watched are not.
    int steps_together() const {
        if (!can_step_in_slabs(model_, work_))
            return 0;
        return watched_ ? std::min(model_.substeps - 1 - substep_, most_slab_steps) : most_slab_steps;
    }
    static std::uint32_t velocities(const State<Real>& state) {
        return (state.velocity.size() != 0 ? 1u : 0u) + (state.previous_velocity.size() != 0 ? 1u : 0u);
    }
    /// The arrays that a state has, in the order of the file.
    template <class S>
    static auto axes(S& state) {
        std::vector<decltype(&state.position.x)> list;
        for (auto* array : {&state.position, &state.previous, &state.velocity, &state.previous_velocity})
            if (array->size() != 0)
                for (auto* axis : {&array->x, &array->y, &array->z})
                    list.push_back(axis);
        return list;
    }

    Model<Real> model_;
    State<Real> state_;
    Workspace<Real> work_;
    StepCounts counts_;
    Monitor<Real> monitor_;
    bool watched_ = false;
};

} // namespace

std::unique_ptr<Simulation> Simulation::create(const Description& description, const Execution& execution) {
    if (description.stepping.precision == Precision::double_precision)
        return std::make_unique<SimulationOf<double>>(description, execution);
    return std::make_unique<SimulationOf<float>>(description, execution);
}

void Simulation::step_frame() {
    advance(description_.stepping.substeps - substep_);
}

void Simulation::count_step() {
    if (++substep_ >= description_.stepping.substeps) {
        substep_ = 0;
        ++frame_;
    }
}

} // namespace clothlab::sim
