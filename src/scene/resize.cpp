#include "scene/resize.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace clothlab::scene {

void resize_grid(Scene& scene, int columns, int rows) {
    sim::Cloth& cloth = scene.simulation.cloth;
    const auto moved = [](int at, int from, int to) {
        return static_cast<int>(std::lround(static_cast<double>(at) * (to - 1) / (from - 1)));
    };
    // Neighbouring pins, as along a flag's pole, stay neighbours: the gaps between them are pinned too.
    std::vector<sim::GridPoint> pins;
    const auto pinned = [&](int column, int row) {
        return std::find(cloth.pinned.begin(), cloth.pinned.end(), sim::GridPoint{column, row}) != cloth.pinned.end();
    };
    for (const auto& [column, row] : cloth.pinned) {
        const int c = moved(column, cloth.num_width_points, columns), r = moved(row, cloth.num_height_points, rows);
        pins.push_back({c, r});
        if (pinned(column + 1, row))
            for (int i = c + 1; i < moved(column + 1, cloth.num_width_points, columns); ++i)
                pins.push_back({i, r});
        if (pinned(column, row + 1))
            for (int i = r + 1; i < moved(row + 1, cloth.num_height_points, rows); ++i)
                pins.push_back({c, i});
    }
    std::sort(pins.begin(), pins.end());
    pins.erase(std::unique(pins.begin(), pins.end()), pins.end());
    cloth.pinned = std::move(pins);
    cloth.num_width_points = columns;
    cloth.num_height_points = rows;
}

} // namespace clothlab::scene
