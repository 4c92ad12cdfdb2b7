#include "app/ghost_view.h"

namespace clothlab::app {

GhostView compare_with_ghost(const std::shared_ptr<const sim::Snapshot>& snapshot, const sim::Snapshot* ghost) {
    GhostView view{snapshot, {}};
    if (!snapshot || !ghost || snapshot->columns != ghost->columns || snapshot->rows != ghost->rows ||
        snapshot->positions.size() != ghost->positions.size())
        return view;
    std::vector<float> distances;
    view.distance = timeline::distance(snapshot->positions, ghost->positions, distances);
    const bool first = snapshot->quantity_kind == sim::PointQuantity::distance;
    const bool second = snapshot->second_quantity_kind == sim::PointQuantity::distance;
    if (!first && !second)
        return view;
    auto copy = std::make_shared<sim::Snapshot>(*snapshot);
    copy->capture = 0; // what the renderer has by that number has no distances
    if (first)
        copy->quantity = distances;
    if (second)
        copy->second_quantity = std::move(distances);
    view.snapshot = std::move(copy);
    return view;
}

} // namespace clothlab::app
