// Curves with as many points as a screen can show.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "timeline/overview.h"

namespace clothlab::ui {

/// Points of a polyline; a y that is not a number breaks it.
struct Curve {
    std::vector<double> x, y;
};

/// Where a curve is drawn: the frames seen, and how many pixels wide.
struct CurveRange {
    double first = 0, last = 1;
    int columns = 1;
    bool operator==(const CurveRange&) const = default;
};

/// Whether all frames from one to another can be reached.
bool reachable_between(std::span<const timeline::FrameRange> reachable, std::uint64_t first, std::uint64_t last);

/// The curves of items that are sorted by `frame`, in one pass over those in the range and one on each side of it.
/// `values(item, out)` writes `series` numbers. Where there are more items than pixels, what is left of each pixel
/// column is its least and its greatest value, in their order: what is drawn is the same. A curve is broken at
/// frames that are missing (not reachable) if that is wider than a pixel.
template <class Item, class Values>
std::vector<Curve> decimate(std::span<const Item> items, std::size_t series, Values values, const CurveRange& range,
                            std::span<const timeline::FrameRange> reachable) {
    std::vector<Curve> curves(series);
    if (items.empty() || series == 0 || !(range.last > range.first) || range.columns < 1)
        return curves;
    const auto before = [](const Item& item, double frame) { return static_cast<double>(item.frame) < frame; };
    auto begin = std::lower_bound(items.begin(), items.end(), range.first, before);
    auto end = std::lower_bound(items.begin(), items.end(), range.last, before);
    begin -= begin != items.begin();
    end += end != items.end();
    const double columns_per_frame = range.columns / (range.last - range.first);
    const bool all = end - begin <= 2 * range.columns;

    // The column under way, by series: frame and value of the least and the greatest.
    struct Extremes {
        double least_at, least, greatest_at, greatest;
    };
    std::vector<Extremes> column(series);
    std::vector<float> now(series);
    double index = std::numeric_limits<double>::quiet_NaN(); // of the column under way; none before the first
    const auto finish = [&] {
        if (std::isnan(index))
            return;
        for (std::size_t i = 0; i < series; ++i) {
            const Extremes& e = column[i];
            const bool least_first = e.least_at <= e.greatest_at;
            const auto add = [&](double x, double y) {
                curves[i].x.push_back(x);
                curves[i].y.push_back(y);
            };
            add(least_first ? e.least_at : e.greatest_at, least_first ? e.least : e.greatest);
            if (e.least_at != e.greatest_at)
                add(least_first ? e.greatest_at : e.least_at, least_first ? e.greatest : e.least);
        }
    };
    std::uint64_t last_frame = begin->frame;
    for (auto item = begin; item != end; ++item) {
        const auto frame = static_cast<double>(item->frame);
        values(*item, now.data());
        const auto gap = static_cast<double>(item->frame - last_frame) * columns_per_frame;
        if (item->frame > last_frame + 1 && gap >= 1 && !reachable_between(reachable, last_frame, item->frame)) {
            finish();
            for (Curve& curve : curves) {
                curve.x.push_back(frame);
                curve.y.push_back(std::numeric_limits<double>::quiet_NaN());
            }
            index = std::numeric_limits<double>::quiet_NaN();
        }
        last_frame = item->frame;
        const double at = all ? frame : std::floor((frame - range.first) * columns_per_frame);
        if (at != index) {
            finish();
            index = at;
            for (std::size_t i = 0; i < series; ++i) {
                const auto y = static_cast<double>(now[i]);
                column[i] = {frame, y, frame, y};
            }
            continue;
        }
        for (std::size_t i = 0; i < series; ++i) {
            const auto y = static_cast<double>(now[i]);
            if (y < column[i].least)
                column[i].least = y, column[i].least_at = frame;
            if (y > column[i].greatest)
                column[i].greatest = y, column[i].greatest_at = frame;
        }
    }
    finish();
    return curves;
}

} // namespace clothlab::ui
