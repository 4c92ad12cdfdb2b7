// From the inside of a step to what is drawn of it: the cloth after one of its stages, and what the stage did as
// arrows.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "render/renderer.h"
#include "ui/lab.h"

namespace clothlab::app {

/// What of a trace the viewport shows; without a trace the snapshot as it is. While it stays the same, so does the
/// picture.
struct TraceChoice {
    std::shared_ptr<const sim::StepTrace> trace;
    int stage = -1; ///< of sim::Stage; -1: the state before the step
    std::optional<std::uint32_t> picked;
    float scale = 1; ///< drawn length / real length
    bool operator==(const TraceChoice&) const = default;
};
TraceChoice trace_choice(const ui::Lab& lab);

class TraceView {
public:
    /// Puts what is chosen in place of the scene's cloth: points where they are after the stage, with an arrow from
    /// where each was before it along ui::effect, as long as the choice's scale makes it. Quantities that colour the
    /// cloth stay those of the state before the step. Does nothing without a trace. This must outlive the drawing.
    void show(const TraceChoice& choice, render::Scene& scene);

private:
    sim::Snapshot snapshot_;
    std::vector<render::Arrow> arrows_;
};

} // namespace clothlab::app
