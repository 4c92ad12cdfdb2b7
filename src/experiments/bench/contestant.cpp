#include "experiments/bench/contestant.h"

#include <algorithm>
#include <thread>

#include "sim/simulation.h"

namespace clothlab::experiments {
namespace {

std::size_t index(sim::Precision precision) {
    return static_cast<std::size_t>(precision);
}

std::unique_ptr<sim::Simulation> simulate(sim::Description description, sim::Precision precision,
                                          const sim::Execution& execution) {
    description.stepping.precision = precision;
    return sim::Simulation::create(description, execution);
}

std::vector<sim::Vec3> positions(const sim::Simulation& simulation) {
    std::vector<sim::Vec3> result(simulation.points());
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = simulation.position(i);
    return result;
}

class SimulationContestant final : public Contestant {
public:
    SimulationContestant(const sim::Description& description, sim::Precision precision, const sim::Execution& execution)
        : simulation_(simulate(description, precision, execution)) {}
    void start_from(const Moment& moment) override {
        simulation_->change(simulation_->description()); // forgets what its stages keep from step to step
        simulation_->load_state(moment.saved[index(simulation_->description().stepping.precision)]);
    }
    sim::StepCounts advance(int steps) override { return simulation_->advance(steps); }
    void time_stages() override { simulation_->time_stages(true); }
    const sim::StageSeconds& stage_seconds() const override { return simulation_->stage_seconds(); }
    std::size_t memory_bytes() const override { return simulation_->memory_bytes(); }
    bool remembers() const override { return simulation_->instructions() != sim::InstructionSet::scalar; }

private:
    std::unique_ptr<sim::Simulation> simulation_;
};

class TextbookContestant final : public Contestant {
public:
    TextbookContestant(const sim::Description& description, CellMap cells) : textbook_(description, cells) {}
    void start_from(const Moment& moment) override { textbook_.place(moment.position, moment.last); }
    sim::StepCounts advance(int steps) override {
        sim::StepCounts sum;
        for (int i = 0; i < steps; ++i)
            sum += textbook_.step();
        return sum;
    }
    void time_stages() override { textbook_.time_stages(true); }
    const sim::StageSeconds& stage_seconds() const override { return textbook_.stage_seconds(); }
    std::size_t memory_bytes() const override { return textbook_.memory_bytes(); }
    bool remembers() const override { return false; }

private:
    Textbook textbook_;
};

} // namespace

Moment advance(const sim::Description& description, int steps, bool single_precision) {
    const auto cores = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 8u));
    const sim::Execution fastest{.threads = cores};
    Moment moment;
    const auto run = simulate(description, sim::Precision::double_precision, fastest);
    run->advance(steps - 1);
    moment.last =
        positions(*run); // Verlet's previous position is that before the step, whatever the step's contacts do
    run->step();
    moment.position = positions(*run);
    moment.saved[index(sim::Precision::double_precision)] = run->save_state();
    if (single_precision) {
        const auto single = simulate(description, sim::Precision::single_precision, fastest);
        single->advance(steps);
        moment.saved[index(sim::Precision::single_precision)] = single->save_state();
    }
    return moment;
}

std::unique_ptr<Contestant> make_contestant(const sim::Description& description, sim::Precision precision,
                                            const sim::Execution& execution) {
    return std::make_unique<SimulationContestant>(description, precision, execution);
}

std::unique_ptr<Contestant> make_textbook_contestant(const sim::Description& description, CellMap cells) {
    return std::make_unique<TextbookContestant>(description, cells);
}

} // namespace clothlab::experiments
