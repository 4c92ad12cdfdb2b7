#include "experiments/stability/bisection.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "experiments/formatted.h"
#include "experiments/run_parallel.h"
#include "experiments/stability/axis.h"
#include "experiments/stability/prediction.h"
#include "experiments/trial.h"
#include "scene/number_text.h"

namespace clothlab::experiments {
namespace {

/// How far from the prediction the first interval's ends are; the next ones if those are alike.
constexpr double reaches[] = {0.02, 0.1, 0.5};
constexpr int most_runs = 100;

class Bisection {
public:
    Bisection(const BisectionConfig& config, const Progress& progress)
        : config_(config), progress_(progress), quantity_(quantity_of(config.key, config.scene)) {
        if (!(config.precision > 0))
            throw Refusal("the precision has to be above 0");
        if (config.from && config.to && !(*config.from < *config.to))
            throw Refusal("--from has to be below --to");
    }

    Findings run() {
        bracket();
        const bool log = low_ > 0;
        while (!close_enough()) {
            double middle = log ? std::sqrt(low_ * high_) : 0.5 * (low_ + high_);
            if (quantity_.whole)
                middle = std::clamp(std::round(middle), low_ + 1, high_ - 1);
            if (!(middle > low_ && middle < high_) || runs_.size() >= most_runs)
                break;
            judge_these({middle});
            (stable(middle) == stable(low_) ? low_ : high_) = middle;
        }
        predict();
        fill();
        say();
        draw();
        return std::move(findings_);
    }

private:
    Settings settings(double value) const { return settings_of(quantity_, value, config_.scene); }
    sim::Description description(double value) const { return with(config_.scene, settings(value)).simulation; }
    bool stable(double value) const { return runs_.at(value).verdict == Verdict::stable; }
    double observed() const { return 0.5 * (low_ + high_); }
    bool close_enough() const {
        return quantity_.whole ? high_ - low_ <= 1
                               : high_ - low_ <= config_.precision * std::max(std::abs(low_), std::abs(high_));
    }
    std::function<double(double)> ratio() const {
        return [this](double value) {
            progress_.tell(0, "predicted limit");
            return limit_ratio(description(value));
        };
    }

    void judge_these(const std::vector<double>& values) {
        std::vector<double> wanted;
        for (const double value : values)
            if (!runs_.contains(value))
                wanted.push_back(value);
        std::vector<Judged> judged(wanted.size());
        const double share = std::min(0.95, static_cast<double>(runs_.size()) / 12);
        run_parallel(
            wanted.size(), config_.threads,
            [&](std::size_t i, const Check& check) { judged[i] = judge(description(wanted[i]), config_.judge, check); },
            [&](std::size_t) {
                progress_.tell(share,
                               quantity_.key + "=" + (wanted.empty() ? "" : scene::shortest_text(wanted.front())));
            });
        for (std::size_t i = 0; i < wanted.size(); ++i)
            runs_[wanted[i]] = std::move(judged[i]);
    }

    double whole(double value, bool up) const {
        return !quantity_.whole ? value : up ? std::ceil(value) : std::floor(value);
    }
    double allowed(double value) const { return std::clamp(value, quantity_.smallest, quantity_.largest); }

    /// Where the ratio crosses 1, going away from the scene's own value by factors of 2.
    std::optional<double> predicted_near_scene() const {
        double begin = value_of(quantity_, config_.scene);
        if (!(begin > 0))
            begin = allowed(1);
        const auto f = ratio();
        const bool beyond = f(begin) > 1;
        std::optional<double> found;
        for (const double factor : {2.0, 0.5}) {
            double before = begin;
            for (int i = 0; i < 24; ++i) {
                const double next = allowed(quantity_.whole ? std::round(before * factor) : before * factor);
                if (next == before || !(next > 0))
                    break;
                if ((f(next) > 1) != beyond) {
                    const std::vector<double> at =
                        crossings(f, {std::min(before, next), std::max(before, next)}, true, quantity_.whole);
                    if (!at.empty() &&
                        (!found || std::abs(std::log(at.front() / begin)) < std::abs(std::log(*found / begin))))
                        found = at.front();
                    break;
                }
                before = next;
            }
        }
        return found;
    }

    void bracket() {
        if (config_.from && config_.to) {
            low_ = whole(*config_.from, false);
            high_ = whole(*config_.to, true);
            judge_these({low_, high_});
            if (stable(low_) == stable(high_))
                throw Refusal(formatted("%s: both ends of the range, %s and %s, are %s", quantity_.key.c_str(),
                                        scene::shortest_text(low_).c_str(), scene::shortest_text(high_).c_str(),
                                        stable(low_) ? "stable" : "unstable"));
            return;
        }
        const std::optional<double> near = predicted_near_scene();
        if (!near)
            throw Refusal(quantity_.key + ": no limit is predicted for any value of it that was looked at; give --from "
                                          "and --to to look for one all the same");
        for (const double reach : reaches) {
            low_ = config_.from ? *config_.from : allowed(whole(*near * (1 - reach), false));
            high_ = config_.to ? *config_.to : allowed(whole(*near * (1 + reach), true));
            if (!(low_ < high_))
                throw Refusal(formatted("%s: the limit is predicted at %s, outside of the range", quantity_.key.c_str(),
                                        scene::shortest_text(*near).c_str()));
            judge_these({low_, high_});
            if (stable(low_) != stable(high_))
                return;
        }
        throw Refusal(formatted("%s: the limit is predicted at %s, but %s and %s are both %s; give --from and --to",
                                quantity_.key.c_str(), scene::shortest_text(*near).c_str(),
                                scene::shortest_text(low_).c_str(), scene::shortest_text(high_).c_str(),
                                stable(low_) ? "stable" : "unstable"));
    }

    /// Near the observed limit: from the start pose, and from the largest omega of the poses of the last stable run.
    void predict() {
        const double last = stable(low_) ? low_ : high_;
        const auto tell = [&] { progress_.tell(0.96, "poses of the last stable run"); };
        const Judged posed = judge(description(last), config_.judge, tell, true);
        const double pose = posed.omega_dt > 0 ? posed.pose_omega_dt / posed.omega_dt : 1;
        const auto nearest = [&](const std::function<double(double)>& f) -> std::optional<double> {
            for (const double reach : {1.05, 2.0, 16.0}) {
                const auto end = [&](double v) { return allowed(quantity_.whole ? std::round(v) : v); };
                double from = end(observed() / reach), to = end(observed() * reach);
                if (from > to)
                    std::swap(from, to);
                const std::vector<double> found = crossings(f, {from, low_, high_, to}, from > 0, quantity_.whole);
                if (!found.empty())
                    return *std::min_element(found.begin(), found.end(), [&](double a, double b) {
                        return std::abs(a - observed()) < std::abs(b - observed());
                    });
            }
            return std::nullopt;
        };
        const auto f = ratio();
        predicted_ = nearest(f);
        predicted_in_motion_ = nearest([&](double value) { return pose * f(value); });
    }

    /// Observed over predicted, in percent; of whole numbers 0 where the prediction is between the two.
    std::optional<double> distance(const std::optional<double>& predicted) const {
        if (!predicted)
            return std::nullopt;
        if (quantity_.whole && *predicted >= low_ && *predicted <= high_)
            return 0;
        return 100 * (observed() / *predicted - 1);
    }

    void fill() {
        const std::string unit = quantity_.unit.empty() ? "" : " (" + quantity_.unit + ")", name = quantity_.column;
        findings_.table.columns = {{name, quantity_.label, 7},
                                   {"verdict", "Verdict"},
                                   {"omega_dt_over_limit", "omega dt / limit", 6},
                                   {"gain_per_step", "Gain a step", 3},
                                   {"judged_after_s", "Judged after (s)", 4},
                                   {"predicted_" + name, "Predicted" + unit, 6},
                                   {"predicted_in_motion_" + name, "Predicted in motion" + unit, 6},
                                   {"observed_" + name, "Observed" + unit, 6},
                                   {"distance_percent", "Observed beyond predicted (%)", 3},
                                   {"distance_in_motion_percent", "In motion (%)", 3},
                                   {"cause", "Cause"}};
        const auto optional = [](const std::optional<double>& value) { return value ? Value(*value) : Value(); };
        const double last = stable(low_) ? low_ : high_;
        for (const auto& [value, run] : runs_) {
            Value ratio;
            if (run.limit > 0 && std::isfinite(run.omega_dt))
                ratio = run.omega_dt / run.limit;
            const bool here = value == last;
            findings_.table.rows.push_back(
                {value, verdict_names[static_cast<std::size_t>(run.verdict)], ratio, optional(run.gain), run.time,
                 here ? optional(predicted_) : Value(), here ? optional(predicted_in_motion_) : Value(),
                 here ? Value(observed()) : Value(), here ? optional(distance(predicted_)) : Value(),
                 here ? optional(distance(predicted_in_motion_)) : Value(), run.cause});
            findings_.settings.push_back(settings(value));
        }
    }

    void say() {
        findings_.title = "Stability limit of " + config_.scene.name + " in " + quantity_.label;
        const char *key = quantity_.key.c_str(), *unit = quantity_.unit.c_str();
        const char* space = quantity_.unit.empty() ? "" : " ";
        const bool stable_below = stable(low_);
        std::string sentence = formatted("%s is %s at %s%s%s and %s at %s%s%s", key,
                                         verdict_names[static_cast<std::size_t>(runs_.at(low_).verdict)],
                                         scene::shortest_text(low_).c_str(), space, unit,
                                         verdict_names[static_cast<std::size_t>(runs_.at(high_).verdict)],
                                         scene::shortest_text(high_).c_str(), space, unit);
        if (predicted_ && quantity_.whole && *distance(predicted_) == 0)
            sentence += formatted(": the limit is where it is predicted, at %.5g.", *predicted_);
        else if (predicted_)
            sentence += formatted(": the limit is %.2g %% %s the predicted %.6g%s%s, give or take %.2g %%.",
                                  std::abs(*distance(predicted_)), *distance(predicted_) < 0 ? "below" : "above",
                                  *predicted_, space, unit, 50 * (high_ - low_) / std::abs(observed()));
        else
            sentence += "; no limit is predicted there.";
        findings_.sentences.push_back(sentence);
        if (predicted_ && predicted_in_motion_ && std::abs(*predicted_in_motion_ / *predicted_ - 1) > 1e-4)
            findings_.sentences.push_back(formatted(
                "In the poses that the last stable run goes through, the fastest mode would put it at %.6g%s%s, and "
                "the observed limit %.2g %% %s that.",
                *predicted_in_motion_, space, unit, std::abs(*distance(predicted_in_motion_)),
                *distance(predicted_in_motion_) < 0 ? "below" : "above"));
        findings_.notes = {
            formatted("%zu runs; stable %s the limit%s.", runs_.size(), stable_below ? "below" : "above",
                      quantity_.whole ? ", which is found to 1"
                                      : formatted(", which is found to %.2g %%", 100 * (high_ / low_ - 1)).c_str()),
            formatted(
                "At the start every point is moved by up to %g of the shortest rest length, so that there is something "
                "to grow.",
                start_noise),
            "Predicted is omega dt of the fastest mode of the start pose against the method's limit; contacts and the "
            "stretch limit are not part of it."};
        if (std::any_of(runs_.begin(), runs_.end(), [](const auto& run) { return run.second.gain.has_value(); }))
            findings_.notes.push_back(
                "The cloth stays where it starts, so that the growth of its fastest oscillation is "
                "fitted to the first steps of each run: growing means more than 1e-8 a step.");
    }

    void draw() {
        Chart chart{findings_.title, {quantity_.label, false, {}}, {"omega dt / limit", false, {}}};
        for (std::size_t kind = 0; kind < verdict_names.size(); ++kind) {
            Series series{verdict_names[kind], Mark::points, static_cast<int>(kind), false, {}, {}};
            for (std::size_t row = 0; row < findings_.table.rows.size(); ++row)
                if (findings_.table.text(row, "verdict") == verdict_names[kind] &&
                    std::isfinite(findings_.table.number(row, "omega_dt_over_limit"))) {
                    series.x.push_back(findings_.table.number(row, quantity_.column));
                    series.y.push_back(findings_.table.number(row, "omega_dt_over_limit"));
                    series.rows.push_back(row);
                }
            if (!series.x.empty())
                chart.series.push_back(std::move(series));
        }
        if (predicted_)
            chart.guides.push_back({"predicted", true, *predicted_});
        chart.guides.push_back({"observed", true, observed()});
        findings_.charts.push_back(std::move(chart));
    }

    const BisectionConfig& config_;
    const Progress& progress_;
    Quantity quantity_;
    double low_ = 0, high_ = 0;
    std::map<double, Judged> runs_; ///< by value
    std::optional<double> predicted_, predicted_in_motion_;
    Findings findings_;
};

} // namespace

Findings bisect_stability(const BisectionConfig& config, const Progress& progress) {
    return Bisection(config, progress).run();
}

} // namespace clothlab::experiments
