// Watches a step from within and fills in a StepTrace. It changes neither the state nor what the step computes.
#pragma once

#include "sim/model.h"
#include "sim/state.h"
#include "sim/step_trace.h"
#include "sim/workspace.h"

namespace clothlab::sim {

template <class Real>
class StepRecorder {
public:
    /// `trace` is overwritten and must outlive the recorder.
    explicit StepRecorder(StepTrace& trace) : trace_(trace) {}

    /// The state that a step begins with. Of the workspace only scratch memory is used.
    void begin(const Model<Real>& model, const State<Real>& state, Workspace<Real>& work);
    /// The state as it would be if the step ended after `stage`. To be called for all stages after the forces, in
    /// order, those too that the model does not have.
    void after(Stage stage, bool active, const Model<Real>& model, const State<Real>& state);
    void end(const StepCounts& counts) { trace_.counts = counts; }

private:
    StepTrace& trace_;
    Vec3Array<Real> last_; ///< m, after the stage before
};

extern template class StepRecorder<float>;
extern template class StepRecorder<double>;

} // namespace clothlab::sim
