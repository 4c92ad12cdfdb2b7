// A cloth beside its ghost, the cloth of another future: how far apart they are, and what is drawn of that.
#pragma once

#include <memory>
#include <optional>

#include "sim/snapshot.h"
#include "timeline/comparison.h"

namespace clothlab::app {

struct GhostView {
    /// What is to be drawn: the given snapshot, or, where a quantity of it is the distance (PointQuantity::distance), a
    /// copy that has the distances.
    std::shared_ptr<const sim::Snapshot> snapshot;
    std::optional<timeline::Distance> distance; ///< none without a ghost, and for one with another grid
};

/// Compares a snapshot with that of a ghost; either may be missing. Costs a copy of the snapshot where distances are
/// drawn: for when one of the two is new, not for every frame of the window.
GhostView compare_with_ghost(const std::shared_ptr<const sim::Snapshot>& snapshot, const sim::Snapshot* ghost);

} // namespace clothlab::app
