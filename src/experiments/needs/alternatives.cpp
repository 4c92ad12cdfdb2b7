#include "experiments/needs/alternatives.h"

#include <algorithm>
#include <cmath>

#include "experiments/needs/words.h"
#include "scene/number_text.h"
#include "scene/resize.h"
#include "sim/integrators/integrator.h"

namespace clothlab::experiments::needs {
namespace {

std::string setting(std::string_view key, double value) {
    std::string text = std::string(key) + "=";
    scene::append_number(text, value, false);
    return text;
}

/// How many are left of a number at each share, most first; each below the number and at least `least`.
std::vector<int> fewer(int number, std::initializer_list<double> shares, int least) {
    std::vector<int> list;
    for (const double share : shares) {
        const int left = static_cast<int>(std::floor(number * share));
        if (left >= least && left < number && (list.empty() || left < list.back()))
            list.push_back(left);
    }
    return list;
}

bool is_kept(const Settings& settings, const std::vector<std::string>& kept) {
    return std::any_of(settings.begin(), settings.end(), [&](const std::string& one) {
        const std::string key = one.substr(0, one.find('='));
        return std::any_of(kept.begin(), kept.end(),
                           [&](const std::string& k) { return key == k || key.starts_with(k + "."); });
    });
}

class Collection {
public:
    Collection(const scene::Scene& model, const std::vector<std::string>& kept)
        : model_(model), of_(model.simulation), kept_(kept) {}

    std::vector<Alternative> list;

    void springs() {
        const sim::Cloth& cloth = of_.cloth;
        const auto off = [&](bool enabled, const char* name, const char* key) {
            if (enabled)
                leave_out(Part::springs, std::string("no ") + name + " springs", {std::string(key) + "=false"});
        };
        off(cloth.enable_structural, "structural", "cloth.enable_structural");
        off(cloth.enable_shearing, "shear", "cloth.enable_shearing");
        off(cloth.enable_bending, "bending", "cloth.enable_bending");
    }

    void self_collision() {
        using Rule = sim::SelfCollisionRule;
        const Rule rule = of_.rules.self_collision;
        if (rule == Rule::none)
            return;
        leave_out(Part::self_collision, "no self-collision", {"rules.self_collision=none"});
        if (rule == Rule::triangles)
            coarsen(Part::self_collision, words::self_collision(Rule::neighbours), {"rules.self_collision=neighbours"});
        if (rule != Rule::cs184)
            coarsen(Part::self_collision, words::self_collision(Rule::cs184), {"rules.self_collision=cs184"});
    }

    void limit() {
        if (of_.rules.limit == sim::LimitRule::off)
            return;
        leave_out(Part::limit, "no stretch limit", {"rules.limit=off"});
        if (of_.rules.limit == sim::LimitRule::iterated)
            coarsen(Part::limit, "one sweep of the stretch limit", {"rules.limit=cs184"});
    }

    void wind() {
        const sim::Wind& w = of_.wind;
        if (w.kind == sim::WindKind::none)
            return;
        leave_out(Part::wind, "no wind", {"wind.kind=none"});
        if (w.kind != sim::WindKind::physical)
            return;
        if (w.lift != 0)
            leave_out(Part::wind, "no lift", {"wind.lift=0"});
        if (w.drag != 0)
            leave_out(Part::wind, "no drag", {"wind.drag=0"});
        if (w.gust != 0)
            leave_out(Part::wind, "no gusts", {"wind.gust=0"});
    }

    void damping() {
        const bool course = of_.rules.damping == sim::DampingRule::cs184;
        if ((course ? of_.cloth.damping : of_.cloth.damping_rate) != 0)
            leave_out(Part::damping, "no damping", {course ? "cloth.damping=0" : "cloth.damping_rate=0"});
        if (uses(sim::uses_spring_damping) && of_.stepping.spring_damping != 0)
            leave_out(Part::damping, "no spring damping", {"simulation.spring_damping=0"});
    }

    void colliders() {
        Settings without_friction;
        for (std::size_t i = 0; i < of_.colliders.size(); ++i)
            if (std::visit([](const auto& shape) { return shape.friction; }, of_.colliders[i]) != 0)
                without_friction.push_back("colliders." + std::to_string(i) + ".friction=0");
        if (!without_friction.empty())
            leave_out(Part::friction, "no friction", without_friction);
        for (std::size_t i = 0; i < of_.colliders.size(); ++i) {
            leave_out(Part::collider, "without " + words::collider(of_.colliders[i]),
                      {"colliders." + std::to_string(i) + "=none"});
            if (!list.empty() && list.back().part == Part::collider)
                list.back().collider = i;
        }
    }

    void substeps() {
        for (const int n : fewer(of_.stepping.substeps, {7.0 / 8, 3.0 / 4, 1.0 / 2, 1.0 / 4}, 1))
            coarsen(Part::substeps, words::counted(n, "substep"), with_substeps(n));
    }

    void precision() {
        if (of_.stepping.precision == sim::Precision::double_precision)
            coarsen(Part::precision, "single precision", {"simulation.precision=single"});
    }

    void resolution() {
        const int columns = of_.cloth.num_width_points, rows = of_.cloth.num_height_points;
        for (const double share : {7.0 / 8, 3.0 / 4, 1.0 / 2}) {
            // Shares of the spaces between points, so that half as many of 51 points are 26: every other one.
            const auto points = [share](int n) { return static_cast<int>(std::lround((n - 1) * share)) + 1; };
            const int fewer_columns = points(columns), fewer_rows = points(rows);
            if (std::min(fewer_columns, fewer_rows) < 3 || (fewer_columns == columns && fewer_rows == rows))
                continue;
            scene::Scene resized = model_;
            scene::resize_grid(resized, fewer_columns, fewer_rows);
            Settings settings{"cloth.num_width_points=" + std::to_string(fewer_columns),
                              "cloth.num_height_points=" + std::to_string(fewer_rows)};
            if (!of_.cloth.pinned.empty())
                settings.push_back("cloth.pinned=" + words::pins(resized.simulation.cloth.pinned));
            coarsen(Part::resolution, words::grid(resized.simulation.cloth), settings);
        }
    }

    void methods() {
        for (const sim::IntegratorInfo& method : sim::integrators()) {
            if (method.id == of_.stepping.integrator)
                continue;
            std::vector<int> levels = fewer(of_.stepping.substeps, {1.0 / 2, 1.0 / 4, 1.0 / 8, 1.0 / 16, 1.0 / 32}, 1);
            levels.insert(levels.begin(), of_.stepping.substeps);
            for (auto n = levels.rbegin(); n != levels.rend(); ++n) {
                Settings settings{"simulation.integrator=" + std::string(method.name)};
                if (*n != of_.stepping.substeps)
                    settings = joined(settings, with_substeps(*n));
                coarsen(Part::method, words::counted(*n, "substep") + " of " + std::string(method.title), settings);
            }
        }
    }

    void solver() {
        const sim::Stepping& s = of_.stepping;
        if (uses(sim::uses_iterations))
            for (const int n : fewer(s.iterations, {3.0 / 4, 1.0 / 2, 1.0 / 4}, 1))
                coarsen(Part::solver, words::counted(n, "iteration"), {"simulation.iterations=" + std::to_string(n)});
        if ((uses(sim::uses_tolerance) || of_.rules.limit == sim::LimitRule::iterated) && s.tolerance > 0)
            for (const double factor : {10.0, 100.0})
                if (s.tolerance * factor <= 0.1)
                    coarsen(Part::solver, "solver tolerance " + words::number(s.tolerance * factor),
                            {setting("simulation.tolerance", s.tolerance * factor)});
    }

private:
    bool uses(sim::MethodOption option) const { return (sim::traits(of_.stepping.integrator).options & option) != 0; }

    Settings with_substeps(int n) const {
        Settings settings{"simulation.substeps=" + std::to_string(n)};
        const double kept_share = 1 - of_.cloth.damping / 100;
        if (of_.rules.damping == sim::DampingRule::cs184 && of_.cloth.damping > 0 && kept_share > 0) {
            const double ratio = static_cast<double>(of_.stepping.substeps) / n;
            const Settings damping{setting("cloth.damping", 100 * (1 - std::pow(kept_share, ratio)))};
            if (!is_kept(damping, kept_))
                settings.push_back(damping.front());
        }
        return settings;
    }

    void add(Part part, bool omission, const std::string& what, const Settings& settings) {
        if (!is_kept(settings, kept_))
            list.push_back({what, part, omission, settings, 0});
    }
    void leave_out(Part part, const std::string& what, const Settings& settings) { add(part, true, what, settings); }
    void coarsen(Part part, const std::string& what, const Settings& settings) { add(part, false, what, settings); }

    const scene::Scene& model_;
    const sim::Description& of_;
    const std::vector<std::string>& kept_;
};

bool is_collider(const std::string& key) {
    return key.starts_with("colliders.");
}

} // namespace

std::vector<Alternative> alternatives(const scene::Scene& model, const std::vector<std::string>& kept) {
    Collection all(model, kept);
    all.springs();
    all.self_collision();
    all.limit();
    all.wind();
    all.damping();
    all.colliders();
    all.substeps();
    all.precision();
    all.resolution();
    all.methods();
    all.solver();
    return std::move(all.list);
}

Settings joined(const Settings& first, const Settings& second) {
    const auto key = [](const std::string& one) { return one.substr(0, one.find('=')); };
    Settings all;
    for (const std::string& one : first) {
        // A collider's number means another one after one before it has left: those stay as they are.
        const bool overridden = !is_collider(one) && std::any_of(second.begin(), second.end(), [&](const auto& other) {
            return key(other) == key(one);
        });
        if (!overridden)
            all.push_back(one);
    }
    all.insert(all.end(), second.begin(), second.end());
    return all;
}

Settings together(const std::vector<Alternative>& list) {
    Settings all;
    for (const Alternative& one : list)
        if (one.part != Part::collider)
            all = joined(all, one.settings);
    for (auto one = list.rbegin(); one != list.rend(); ++one)
        if (one->part == Part::collider)
            all = joined(all, one->settings);
    return all;
}

std::string in_words(const scene::Scene& model, const scene::Scene& full) {
    return words::difference(model.simulation, full.simulation);
}

} // namespace clothlab::experiments::needs
