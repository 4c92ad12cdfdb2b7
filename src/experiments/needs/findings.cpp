#include "experiments/needs/findings.h"

#include <algorithm>
#include <cmath>

#include "experiments/needs/words.h"

namespace clothlab::experiments::needs {
namespace {

using words::number;

std::string amount(const Config& config, double value) {
    return number(value) + " " + std::string(info(config.quantity).unit);
}

/// "RMS distance over time"
std::string what_counts(const Config& config) {
    std::string text(info(config.quantity).title);
    if (config.quantity != Quantity::first_contact)
        text += config.at_end ? " at the end" : " over time";
    return text;
}

std::string off(const Config& config, const Trial& trial) {
    if (trial.verdict == Verdict::fails)
        return trial.trouble;
    if (std::isinf(trial.deviation))
        return "touches nothing";
    return amount(config, trial.deviation) + " off";
}

std::string faster(double speed_up) {
    return number(speed_up) + " x faster";
}

// --- the table -------------------------------------------------------------------------------------------------------

std::vector<Column> columns(const Config& config) {
    const std::string unit(info(config.quantity).unit);
    return {{"stage", "Stage"},
            {"model", "Model"},
            {"cost_s_per_s", "Cost (s per simulated s)", 3},
            {"spread_percent", "Spread (%)", 2},
            {"speed_up", "Speed-up", 4},
            {"deviation_" + unit, "Deviation (" + unit + ")", 3},
            {"within", "Within"},
            {"evidence", "Evidence"}};
}

std::string evidence(const Trial& trial, const Trial* beaten) {
    if (!trial.proof.empty()) {
        std::string text = "proof: ";
        for (std::size_t i = 0; i < trial.proof.size(); ++i)
            text += (i ? "; " : "") + trial.proof[i];
        return text;
    }
    if (!trial.trouble.empty())
        return "trial: " + trial.trouble;
    if (std::isinf(trial.deviation))
        return "trial: touches no collider";
    if (beaten && trial.verdict == Verdict::within)
        return "trial: not faster";
    return "trial";
}

class Rows {
public:
    Rows(const Config& config, Findings& findings) : config_(config), findings_(findings) {
        findings.table.columns = columns(config);
    }

    /// With `beaten`, a model that is not taken within the tolerance is said to be no faster than that one.
    std::size_t add(const std::string& stage, const std::string& what, const Trial& trial,
                    const Trial* beaten = nullptr) {
        const auto positive = [](double value) { return value > 0 && std::isfinite(value) ? Value(value) : Value(); };
        const Value spread = trial.timed && !config_.known_cost ? Value(100 * trial.cost.spread()) : Value();
        const bool judged = trial.verdict != Verdict::slower;
        findings_.table.rows.push_back(
            {stage, what, positive(trial.cost.median), spread, trial.cost.median > 0 ? Value(trial.speed_up) : Value(),
             std::isfinite(trial.deviation) ? Value(trial.deviation) : Value(),
             judged ? Value(trial.verdict == Verdict::within ? "yes" : "no") : Value(), evidence(trial, beaten)});
        findings_.settings.push_back(trial.settings);
        return findings_.table.rows.size() - 1;
    }

private:
    const Config& config_;
    Findings& findings_;
};

/// The rows of each stage, from the first to behind the last.
struct Stages {
    std::size_t alone = 0, path = 0, recommended = 0, more = 0;
};

Stages fill_table(const Config& config, const Found& found, Findings& findings) {
    Rows rows(config, findings);
    Stages first;
    rows.add("full model", found.full.what, found.full);
    findings.table.rows.back().back() = "the yardstick";
    first.alone = findings.table.rows.size();
    for (const Trial& trial : found.alone)
        rows.add("alone", trial.what, trial);
    first.path = findings.table.rows.size();
    for (std::size_t i = 0; i < found.path.size(); ++i)
        rows.add(found.path[i].proof.empty() ? "greedy" : "free", (i == 0 ? "" : "and ") + found.path[i].what,
                 found.path[i]);
    first.recommended = findings.table.rows.size();
    const std::string name = in_words(found.recommended.scene, config.scene);
    rows.add("recommended", name, found.recommended);
    rows.add("run again", name, found.again);
    first.more = findings.table.rows.size();
    for (const Trial& trial : found.more)
        rows.add("one more", trial.what, trial, &found.recommended);
    return first;
}

// --- the chart -------------------------------------------------------------------------------------------------------

/// Where a deviation of zero is drawn: below all that is not, by whole decades.
double floor_of(const Config& config, const Found& found) {
    double least = config.tolerance;
    for (const auto* trials : {&found.alone, &found.path, &found.more})
        for (const Trial& trial : *trials)
            if (trial.deviation > 0)
                least = std::min(least, trial.deviation);
    return std::pow(10, std::floor(std::log10(std::max(least, 1e-9 * config.tolerance))) - 1);
}

void add_point(Series& series, const Trial& trial, std::size_t row, double zero) {
    if (!std::isfinite(trial.deviation) || !(trial.cost.median > 0))
        return;
    series.x.push_back(trial.speed_up);
    series.y.push_back(std::max(trial.deviation, zero));
    series.rows.push_back(row);
    const bool measured = trial.timed && trial.cost.min > 0;
    series.x_low.push_back(measured ? trial.speed_up * trial.cost.median / trial.cost.max : trial.speed_up);
    series.x_high.push_back(measured ? trial.speed_up * trial.cost.median / trial.cost.min : trial.speed_up);
}

Chart chart_of(const Config& config, const Found& found, const Stages& first) {
    const double zero = floor_of(config, found);
    Chart chart;
    chart.title = config.scene.name + ": what leaving out gains and changes";
    chart.x = {"Speed-up over the full model", true};
    chart.y = {what_counts(config) + " (" + std::string(info(config.quantity).unit) + "; 0 is drawn at " +
                   number(zero) + ")",
               true};
    Series proved{"free, by proof", Mark::points, -1, false, {}, {}};
    Series omitted{"one thing left out", Mark::points, -1, false, {}, {}};
    Series coarser{"one thing coarser", Mark::points, -1, false, {}, {}};
    Series methods{"another method", Mark::points, -1, false, {}, {}};
    for (std::size_t i = 0; i < found.alone.size(); ++i) {
        const Trial& trial = found.alone[i];
        Series& series = !trial.proof.empty()                     ? proved
                         : trial.alternative.omission             ? omitted
                         : trial.alternative.part == Part::method ? methods
                                                                  : coarser;
        add_point(series, trial, first.alone + i, zero);
    }
    Series path{"greedy, step by step", Mark::line_and_points, -1, true, {}, {}};
    add_point(path, found.full, 0, zero);
    for (std::size_t i = 0; i < found.path.size(); ++i)
        add_point(path, found.path[i], first.path + i, zero);
    Series more{"one more from there", Mark::points, -1, false, {}, {}};
    for (std::size_t i = 0; i < found.more.size(); ++i)
        add_point(more, found.more[i], first.more + i, zero);
    Series recommended{"recommended", Mark::points, -1, true, {}, {}};
    add_point(recommended, found.recommended, first.recommended, zero);
    for (Series* series : {&proved, &omitted, &coarser, &methods, &more, &path, &recommended})
        if (!series->x.empty())
            chart.series.push_back(std::move(*series));
    chart.guides = {{"tolerance " + amount(config, config.tolerance), false, config.tolerance},
                    {"as fast as the full model", true, 1}};
    return chart;
}

// --- sentences -------------------------------------------------------------------------------------------------------

std::string headline(const Config& config, const Found& found) {
    if (found.path.empty())
        return "Nothing can be left out or made coarser within " + amount(config, config.tolerance) +
               " that makes it faster.";
    const Trial& model = found.recommended;
    return in_words(model.scene, config.scene) + ": " + faster(model.speed_up) + ", " + off(config, model) +
           " (wanted " + amount(config, config.tolerance) + ", " + what_counts(config) + ").";
}

std::string promise(const Config& config, const Found& found) {
    return "Run again, it was " + faster(found.again.speed_up) + " (promised " + number(found.recommended.speed_up) +
           ") and " + off(config, found.again) + ".";
}

std::string proofs(const Found& found) {
    std::vector<std::string> free;
    for (const Trial& trial : found.alone)
        if (!trial.proof.empty())
            free.push_back(trial.what + " (" + trial.proof.front() + ")");
    if (free.empty())
        return "Nothing is proved to be free to drop.";
    return "Free to drop to the last bit, by proof: " + words::listed(free) + ".";
}

/// What the recommended model still has and needs: each omission, and the nearest thing made coarser.
std::string one_more(const Config& config, const Found& found) {
    std::vector<std::string> needed, not_faster;
    const Trial* nearest = nullptr;
    for (const Trial& trial : found.more) {
        const bool breaks = trial.verdict == Verdict::breaks || trial.verdict == Verdict::fails;
        if (trial.alternative.omission)
            (breaks ? needed : not_faster)
                .push_back(trial.what + " (" + (breaks ? off(config, trial) : "not faster") + ")");
        else if (trial.verdict == Verdict::breaks && (!nearest || trial.deviation < nearest->deviation))
            nearest = &trial;
    }
    std::string text;
    if (!needed.empty())
        text += "Leaving out one more thing breaks the tolerance: " + words::listed(needed) + ". ";
    if (!not_faster.empty())
        text += "Left in, as it is slower without: " + words::listed(not_faster) + ". ";
    if (nearest)
        text +=
            "Of what could be coarser, " + nearest->what + " breaks it by the least: " + off(config, *nearest) + ". ";
    text += "Every other step from there breaks it or is not faster.";
    return text;
}

/// The omissions that change most.
std::string what_matters(const Config& config, const Found& found) {
    std::vector<const Trial*> omissions;
    for (const Trial& trial : found.alone)
        if (trial.alternative.omission && trial.proof.empty() && trial.verdict != Verdict::within)
            omissions.push_back(&trial);
    const auto size = [](const Trial* trial) {
        return std::isfinite(trial->deviation) ? trial->deviation : std::numeric_limits<double>::infinity();
    };
    std::stable_sort(omissions.begin(), omissions.end(),
                     [&](const Trial* a, const Trial* b) { return size(a) > size(b); });
    std::vector<std::string> list;
    for (const Trial* trial : omissions)
        list.push_back(trial->what + " (" + (trial->verdict == Verdict::slower ? trial->trouble : off(config, *trial)) +
                       ")");
    if (list.empty())
        return "Of the full model, any single thing can be left out within the tolerance.";
    return "Of the full model, left out alone, these break the tolerance: " + words::listed(list) + ".";
}

std::vector<std::string> notes_of(const Config& config, const Found& found) {
    std::vector<std::string> notes{
        "Deviations are from the scene as it is, the full model, not from the truth: " + what_counts(config) + ", " +
            (config.quantity == Quantity::first_contact ? "to the length of a step."
             : config.at_end
                 ? "at frame " + std::to_string(found.course.frames) + "."
                 : "the largest of " + std::to_string(found.yardstick.shapes.size()) +
                       " comparisons, the last at the end. Coarser grids are interpolated and compared at all "
                       "points of the full model."),
        "A nudge of the full model's start by up to " + number(found.nudge) + " m moves it by " +
            amount(config, found.noise) + "."};
    if (config.known_cost)
        notes.emplace_back("Costs were given, not measured.");
    else
        notes.push_back(
            "Costs are wall time of the steps alone, in " + words::counted(config.threads, "thread") +
            ": medians of 3 rounds by turns with the full model, of 7 for the recommended one, with their spread, "
            "(largest - smallest) / median. Faster means by at least " +
            number(100 * least_gain) + " %.");
    notes.emplace_back(
        "With fewer substeps, the course's damping per substep is raised so that as much of the motion is "
        "lost in a second.");
    if (!config.kept.empty())
        notes.push_back("Not touched: " + words::listed(config.kept) + ".");
    return notes;
}

} // namespace

Findings findings_of(const Config& config, const Found& found) {
    Findings findings;
    findings.seconds = found.course.seconds;
    findings.title = "What " + config.source + " needs over " + number(found.course.seconds, 6) + " s, within " +
                     amount(config, config.tolerance) + " (" + what_counts(config) + ")";
    const Stages first = fill_table(config, found, findings);
    findings.charts.push_back(chart_of(config, found, first));
    findings.sentences = {headline(config, found), promise(config, found), proofs(found), one_more(config, found),
                          what_matters(config, found)};
    findings.notes = notes_of(config, found);
    return findings;
}

scene::Scene recommended_scene(const Config& config, const Found& found) {
    scene::Scene scene = found.recommended.scene;
    scene.name = config.scene.name + ", as little as it needs";
    scene.description = "Found by `clothlab experiment needs` from " + config.source + ", over " +
                        number(found.course.seconds, 6) + " s. " + headline(config, found);
    return scene;
}

} // namespace clothlab::experiments::needs
