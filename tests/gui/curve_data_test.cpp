// Curves are thinned out to what a screen shows, and lose nothing that it would show.
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>

#include "ui/curve_data.h"

namespace clothlab::test {
namespace {

using timeline::Sample;

std::vector<Sample> samples(std::uint64_t count) {
    std::vector<Sample> list(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        list[i].frame = i + 1;
        list[i].kinetic = std::sin(static_cast<float>(i) * 0.01f);
        list[i].spring = 2;
    }
    return list;
}

std::vector<ui::Curve> thinned(const std::vector<Sample>& list, const ui::CurveRange& range,
                               const std::vector<timeline::FrameRange>& reachable = {{0, 1'000'000}}) {
    return ui::decimate(
        std::span<const Sample>(list), 2,
        [](const Sample& s, float* out) {
            out[0] = s.kinetic;
            out[1] = s.spring;
        },
        range, reachable);
}

} // namespace

TEST_CASE("A single spike in 300 000 samples is in a curve of 700 pixels, which has at most two points for each") {
    std::vector<Sample> list = samples(300'000);
    list[123'456].kinetic = 40;
    list[123'457].kinetic = -40;
    const auto curves = thinned(list, {0, 300'000, 700});
    REQUIRE(curves.size() == 2);
    CHECK(curves[0].x.size() <= 2 * 701);
    CHECK(curves[1].x.size() <= 2 * 701);
    const auto highest = std::max_element(curves[0].y.begin(), curves[0].y.end());
    CHECK(*highest == 40);
    CHECK(curves[0].x[static_cast<std::size_t>(highest - curves[0].y.begin())] == 123'457);
    CHECK(*std::min_element(curves[0].y.begin(), curves[0].y.end()) == -40);
    CHECK(std::is_sorted(curves[0].x.begin(), curves[0].x.end()));
}

TEST_CASE("Where there are as many pixels as samples every sample is a point") {
    const std::vector<Sample> list = samples(100);
    const auto curves = thinned(list, {0, 101, 700});
    REQUIRE(curves[0].x.size() == 100);
    for (std::size_t i = 0; i < 100; ++i) {
        CHECK(curves[0].x[i] == static_cast<double>(i + 1));
        CHECK(curves[0].y[i] == static_cast<double>(list[i].kinetic));
    }
}

TEST_CASE("A curve goes on to the samples just beyond the range, and no further") {
    const auto curves = thinned(samples(1000), {100.5, 110.5, 700});
    REQUIRE(curves[0].x.size() == 12);
    CHECK(curves[0].x.front() == 100);
    CHECK(curves[0].x.back() == 111);
}

TEST_CASE("A curve is broken where frames have been dropped, and joined where they only have no sample") {
    std::vector<Sample> list = samples(100);
    list.erase(list.begin() + 40, list.begin() + 60);
    const auto breaks = [&](const std::vector<timeline::FrameRange>& reachable) {
        const auto curves = thinned(list, {0, 101, 700}, reachable);
        return std::count_if(curves[0].y.begin(), curves[0].y.end(), [](double y) { return std::isnan(y); });
    };
    CHECK(breaks({{0, 40}, {61, 100}}) == 1);
    CHECK(breaks({{0, 100}}) == 0);
}

TEST_CASE("There is no curve of nothing") {
    CHECK(thinned({}, {0, 100, 700})[0].x.empty());
    CHECK(thinned(samples(10), {5, 5, 700})[0].x.empty());
}

} // namespace clothlab::test
