#include "experiments/needs/search.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "experiments/needs/chaos.h"
#include "experiments/needs/words.h"

namespace clothlab::experiments::needs {
namespace {

constexpr Turns in_search{3, 0.03}, at_last{7, 0.2};
/// Models that take so many times the time of the one to beat are given up; what leaves something out gets further, as
/// it is to be known whether it breaks the tolerance.
constexpr double much_slower = 2, much_slower_omission = 10;

class Search {
public:
    Search(const Config& config, const Progress& progress)
        : config_(config), progress_(progress), beat_{[this](double, const std::string&) {
              return !progress_.report || progress_.report(share_, what_);
          }} {}

    Found run() {
        begin();
        leave_out_alone();
        drop_what_is_free();
        while (take_another())
            visited_.push_back(model_.scene.simulation);
        time_at_last();
        return std::move(found_);
    }

private:
    void tell(double share, std::string what) {
        share_ = share;
        what_ = std::move(what);
        beat_.tell(share_, what_);
    }

    void begin() {
        tell(0, "the full model");
        found_.course = course_of(config_.scene.simulation, config_.frames, config_.threads);
        found_.yardstick = record(config_.scene.simulation, found_.course, beat_);
        require_sound(config_, found_.yardstick);
        tell(0.01, "the full model, nudged");
        found_.nudge = nudge(*sim::Simulation::create(config_.scene.simulation));
        const double enough = std::numeric_limits<double>::infinity();
        const Record nudged = record(config_.scene.simulation, found_.course, beat_, enough, true);
        found_.noise = noise_of(config_, found_.yardstick, nudged, found_.nudge);
        model_.what = "the scene as it is";
        model_.scene = config_.scene;
        found_.full = model_;
        tell(0.015, "timing the full model");
        time({}, in_search);
        visited_.push_back(model_.scene.simulation);
    }

    /// Runs the present model with each of these alternatives to it; `share` of the work is done when it begins, and
    /// `share + span` when it ends.
    std::vector<Trial> judge_all(const std::vector<Alternative>& all, double share, double span) {
        std::vector<Trial> trials;
        for (std::size_t i = 0; i < all.size(); ++i) {
            tell(share + span * static_cast<double>(i) / static_cast<double>(all.size()), all[i].what);
            Trial trial = made(all[i]);
            const bool hopeless = is_hopeless(trial, trials);
            if (hopeless) {
                trial.verdict = Verdict::slower;
                trial.deviation = std::numeric_limits<double>::quiet_NaN();
                trial.trouble = "not run: much slower already with fewer substeps";
            } else {
                judge(trial, (all[i].omission ? much_slower_omission : much_slower) * model_.cost.median *
                                 found_.course.seconds);
            }
            trials.push_back(std::move(trial));
        }
        return trials;
    }

    /// Methods come with few substeps first: one that is much too slow already is not tried with more.
    static bool is_hopeless(const Trial& trial, const std::vector<Trial>& before) {
        return trial.alternative.part == Part::method && !before.empty() && before.back().verdict == Verdict::slower &&
               before.back().scene.simulation.stepping.integrator == trial.scene.simulation.stepping.integrator;
    }

    Trial made(const Alternative& alternative) const {
        Trial trial;
        trial.what = alternative.what;
        trial.alternative = alternative;
        trial.settings = joined(model_.settings, alternative.settings);
        trial.scene = with(config_.scene, trial.settings);
        return trial;
    }

    void judge(Trial& trial, double most_wall_s) {
        const double most = config_.known_cost ? std::numeric_limits<double>::infinity() : most_wall_s;
        const Record run = record(trial.scene.simulation, found_.course, beat_, most);
        trial.wall_s = run.wall_s;
        trial.deviation = std::numeric_limits<double>::quiet_NaN();
        if (run.trouble) {
            trial.verdict = Verdict::fails;
            trial.trouble = run.trouble->status == sim::Status::jitter ? "jitters" : "diverges";
        } else if (run.given_up) {
            trial.verdict = Verdict::slower;
            trial.trouble = "given up: took " + words::number(most / found_.course.seconds / model_.cost.median) +
                            " x the time of the model before";
        } else {
            trial.deviation = deviation(config_.quantity, found_.yardstick, run, config_.at_end);
            trial.verdict = trial.deviation <= config_.tolerance ? Verdict::within : Verdict::breaks;
        }
        hash_ = run.hash;
    }

    /// Times these beside the full model and the present one.
    void time(const std::vector<Trial*>& trials, const Turns& turns) {
        std::vector<sim::Description> models{config_.scene.simulation, model_.scene.simulation};
        for (const Trial* trial : trials)
            models.push_back(trial->scene.simulation);
        const std::vector<Measured> costs = time_by_turns(models, found_.course, turns, config_.known_cost, beat_);
        const auto set = [&](Trial& trial, std::size_t i) {
            trial.cost = costs[i];
            trial.timed = true;
            trial.speed_up = costs[0].median / costs[i].median;
        };
        set(found_.full, 0);
        set(model_, 1);
        for (std::size_t i = 0; i < trials.size(); ++i)
            set(*trials[i], i + 2);
    }

    /// Those of the trials that ran to the end and were not timed since.
    static std::vector<Trial*> not_timed(std::vector<Trial>& trials) {
        std::vector<Trial*> list;
        for (Trial& trial : trials)
            if (!trial.timed && (trial.verdict == Verdict::within || trial.verdict == Verdict::breaks))
                list.push_back(&trial);
        return list;
    }

    void leave_out_alone() {
        std::vector<Alternative> tried;
        for (const Alternative& one : alternatives(config_.scene, config_.kept)) {
            if (const auto why = proof(one, config_.scene.simulation, found_.yardstick.deeds)) {
                Trial trial = made(one);
                trial.proof = {*why};
                free_.push_back(one);
                found_.alone.push_back(std::move(trial));
            } else {
                tried.push_back(one);
            }
        }
        std::vector<Trial> trials = judge_all(tried, 0.02, 0.3);
        std::move(trials.begin(), trials.end(), std::back_inserter(found_.alone));
        tell(0.32, "timing each");
        time(not_timed(found_.alone), in_search);
    }

    void drop_what_is_free() {
        if (free_.empty())
            return;
        tell(0.5, "all that is free to drop");
        Trial all;
        all.what = "all that is free to drop";
        all.settings = together(free_);
        all.scene = with(config_.scene, all.settings);
        for (const Trial& trial : found_.alone)
            all.proof.insert(all.proof.end(), trial.proof.begin(), trial.proof.end());
        judge(all, std::numeric_limits<double>::infinity());
        if (hash_ != found_.yardstick.hash)
            throw std::logic_error("what was proved to be free to drop changes the run");
        model_ = std::move(all);
        time({}, in_search);
        visited_.push_back(model_.scene.simulation);
        found_.path.push_back(model_);
    }

    bool was_visited(const Trial& trial) const {
        return std::find(visited_.begin(), visited_.end(), trial.scene.simulation) != visited_.end();
    }

    void take(Trial trial) {
        model_ = std::move(trial);
        found_.path.push_back(model_);
    }

    /// Goes on to the best alternative to the present model; false where none is any good.
    bool take_another() {
        const double share = 0.9 - 0.4 * std::pow(0.7, static_cast<double>(found_.path.size()));
        const std::vector<Alternative> all = alternatives(model_.scene, config_.kept);
        std::vector<Trial> trials = judge_all(all, share, 0);
        std::vector<Trial*> fit;
        for (Trial& trial : trials)
            if (trial.verdict == Verdict::within && !was_visited(trial))
                fit.push_back(&trial);
        std::sort(fit.begin(), fit.end(), [](const Trial* a, const Trial* b) { return a->wall_s < b->wall_s; });
        // The cheapest by the run that they were judged by are timed first; all of them only if none of those gains.
        constexpr std::size_t at_a_time = 5;
        for (std::size_t from = 0; from < fit.size(); from += at_a_time) {
            tell(share, "timing the best after " + model_.what);
            const auto begin = fit.begin() + static_cast<std::ptrdiff_t>(from);
            const std::vector<Trial*> batch(
                begin, begin + static_cast<std::ptrdiff_t>(std::min(at_a_time, fit.size() - from)));
            time(batch, in_search);
            Trial* best = *std::min_element(batch.begin(), batch.end(), [](const Trial* a, const Trial* b) {
                return a->cost.median < b->cost.median;
            });
            if (best->cost.median < (1 - least_gain) * model_.cost.median) {
                take(std::move(*best));
                return true;
            }
        }
        Trial* least = nullptr;
        for (Trial* trial : fit)
            if (trial->alternative.omission && trial->cost.min <= (1 + least_gain) * model_.cost.median &&
                (!least || trial->deviation < least->deviation))
                least = trial;
        if (least) {
            take(std::move(*least));
            return true;
        }
        found_.more = std::move(trials);
        time(not_timed(found_.more), in_search);
        return false;
    }

    void time_at_last() {
        tell(0.92, "the full and the recommended model, by turns");
        time({}, at_last);
        found_.recommended = model_;
        tell(0.96, "the same again");
        Trial again = model_;
        judge(again, std::numeric_limits<double>::infinity());
        const std::vector<Measured> costs = time_by_turns({config_.scene.simulation, again.scene.simulation},
                                                          found_.course, at_last, config_.known_cost, beat_);
        again.cost = costs[1];
        again.timed = true;
        again.speed_up = costs[0].median / costs[1].median;
        found_.again = std::move(again);
    }

    const Config& config_;
    const Progress& progress_;
    Progress beat_; ///< tells the last share and word again
    double share_ = 0;
    std::string what_;
    Found found_;
    Trial model_; ///< the present one
    std::vector<Alternative> free_;
    std::vector<sim::Description> visited_;
    std::uint64_t hash_ = 0; ///< of the last run that was judged
};

} // namespace

Found search(const Config& config, const Progress& progress) {
    return Search(config, progress).run();
}

} // namespace clothlab::experiments::needs
