#include "app/trace_view.h"

#include "ui/step_view.h"

namespace clothlab::app {
namespace {

glm::vec3 point_of(const std::vector<float>& positions, std::size_t i) {
    return {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]};
}

} // namespace

TraceChoice trace_choice(const ui::Lab& lab) {
    if (!ui::shown_trace(lab))
        return {};
    const ui::TimelineWork& work = lab.timeline;
    return {work.trace, work.stage, work.picked, work.arrow_scale};
}

void TraceView::show(const TraceChoice& choice, render::Scene& scene) {
    if (!choice.trace || scene.snapshot == nullptr)
        return;
    const sim::StepTrace& trace = *choice.trace;
    const std::size_t points = trace.before.size() / 3;
    arrows_.clear();
    if (choice.picked && *choice.picked < points)
        scene.marker = point_of(trace.before, *choice.picked);
    if (choice.stage < 0)
        return;
    const auto stage = static_cast<std::size_t>(choice.stage);
    const std::vector<float>& before = stage == 0 ? trace.before : trace.after[stage - 1];
    snapshot_ = *scene.snapshot;
    snapshot_.capture = 0;
    snapshot_.positions = trace.after[stage];
    scene.snapshot = &snapshot_;
    const auto& c = ui::stage_colours[stage];
    const auto add = [&](std::size_t i) {
        const sim::Vec3 d = ui::effect(trace, static_cast<sim::Stage>(stage), static_cast<std::uint32_t>(i));
        const glm::vec3 from = point_of(before, i);
        const glm::vec3 way{static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
        if (way != glm::vec3(0))
            arrows_.push_back({from, from + choice.scale * way, {c[0], c[1], c[2]}});
    };
    if (!choice.picked) {
        for (std::size_t i = 0; i < points; ++i)
            add(i);
    } else if (*choice.picked < points) {
        scene.marker = point_of(before, *choice.picked);
        add(*choice.picked);
    }
    scene.arrows = arrows_;
}

} // namespace clothlab::app
