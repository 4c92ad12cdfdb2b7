// The sentences and notes of the accuracy experiment.
#include <algorithm>

#include "experiments/accuracy/analysis.h"
#include "experiments/formatted.h"

namespace clothlab::experiments {
namespace {

void tell_cheapest(const AccuracyAnalysis& a, std::vector<std::string>& sentences) {
    if (!a.timed())
        return;
    for (const double tolerance : a.config.tolerances) {
        const std::string within = formatted("%g %s %s", tolerance, a.quantity.unit, a.quantity.name);
        if (tolerance < a.floor) {
            sentences.push_back("Whether anything is within " + within +
                                " cannot be told: the reference's own error is too large.");
            continue;
        }
        const AccuracyRow* best = nullptr;
        for (const AccuracyRow& row : a.rows) {
            const Attempt& attempt = a.attempt(row);
            if (attempt.status == sim::Status::ok && !attempt.cost.empty() && a.error(attempt) <= tolerance &&
                (!best || a.cost(row) < a.cost(*best)))
                best = &row;
        }
        if (!best) {
            sentences.push_back("Nothing that was run is within " + within + ".");
            continue;
        }
        const Attempt& attempt = a.attempt(*best);
        const double wall = a.cost(*best);
        sentences.push_back(formatted(
            "Within %s the cheapest is %s in %s precision with %s and %s: %.3g s per simulated second, "
            "%.3g times %s than real time; its error is %.3g %s.",
            within.c_str(), a.runs.candidates[attempt.candidate].name.c_str(), name_of(attempt.precision),
            count_of(attempt.substeps, "substep").c_str(), count_of(a.config.threads[best->thread], "thread").c_str(),
            wall, wall < 1 ? 1 / wall : wall, wall < 1 ? "faster" : "slower", a.error(attempt), a.quantity.unit));
    }
}

void tell_slopes(const AccuracyAnalysis& a, std::vector<std::string>& sentences) {
    for (const AccuracyLine& line : a.lines) {
        if (!a.has_slope(line))
            continue;
        const Candidate& candidate = a.runs.candidates[line.candidate];
        const int order = a.method(line.candidate).order;
        if (order == 0) {
            sentences.push_back(candidate.name + " does not converge to the springs' motion.");
            continue;
        }
        const std::string of_order = candidate.rule.empty() ? formatted(" (order %d)", order) : std::string();
        sentences.push_back(line.slope ? formatted("%s%s: slope %.2f over %.1f decades of steps, %d to %d substeps.",
                                                   candidate.name.c_str(), of_order.c_str(), line.slope->slope,
                                                   line.slope->decades,
                                                   a.runs.attempts[line.first + line.slope->first].substeps,
                                                   a.runs.attempts[line.first + line.slope->last].substeps)
                                       : candidate.name + of_order + ": no three steps on end on a line that falls.");
    }
}

void add_left_out(const AccuracyAnalysis& a, std::vector<std::string>& notes) {
    std::string list;
    for (const AccuracyLine& line : a.lines) {
        std::string substeps;
        for (std::size_t i = line.first; i < line.last; ++i)
            if (a.runs.attempts[i].left_out)
                substeps += (substeps.empty() ? "" : ", ") + std::to_string(a.runs.attempts[i].substeps);
        if (!substeps.empty())
            list += (list.empty() ? "" : "; ") + a.runs.candidates[line.candidate].name + " in " +
                    name_of(line.precision) + " precision with " + substeps;
    }
    if (!list.empty())
        notes.push_back(
            formatted("Left out, since a run would take more than %g s of processor time: ", a.config.budget) + list +
            " substeps.");
}

} // namespace

std::vector<std::string> accuracy_sentences(const AccuracyAnalysis& a) {
    std::vector<std::string> sentences;
    tell_cheapest(a, sentences);
    tell_slopes(a, sentences);
    return sentences;
}

std::vector<std::string> accuracy_notes(const AccuracyAnalysis& a) {
    const Reference& reference = a.runs.reference;
    std::vector<std::string> notes = reference.notes;
    notes.insert(notes.begin(), formatted("Shapes are compared after %llu frames, %.4g s.",
                                          static_cast<unsigned long long>(a.runs.frames), a.seconds()));
    notes.push_back(formatted(
        "The reference is %s in double precision with %d substeps; from %d, %d and %d substeps its own error is "
        "estimated as %.2g %s. What is below %g times that takes no part in slopes.",
        std::string(sim::integrators()[static_cast<std::size_t>(reference.description.stepping.integrator)].name)
            .c_str(),
        reference.substeps[2], reference.substeps[0], reference.substeps[1], reference.substeps[2],
        a.floor / resolution, a.quantity.unit, resolution));
    notes.push_back(
        formatted("A start perturbed by %.0e m is %.2g mm off at the end: %.3g times as much; up to %.0e is "
                  "accepted.",
                  perturbation, 1000 * reference.growth.apart, reference.growth.factor, most_growth));
    notes.push_back(formatted("A slope is fitted to the longest run of steps on a line: no local slope is more than "
                              "%g off.",
                              straightness));
    if (a.timed())
        notes.push_back(formatted(
            "Times are medians of %d rounds by turns, with the least and the most; in each a run takes steps for "
            "about %.0f ms, from states spread evenly over the motion. Instruction set: %s.",
            a.config.rounds, a.config.slot * 1000,
            std::string(
                sim::instruction_sets()[static_cast<std::size_t>(sim::resolve(sim::InstructionSet::automatic))].name)
                .c_str()));
    add_left_out(a, notes);
    return notes;
}

} // namespace clothlab::experiments
