// The curve of a ghost's distance, computed in the background.
#include "app/core/comparison_job.h"

#include <algorithm>
#include <catch2/catch_test_macros.hpp>

#include "support/branches.h"

using namespace clothlab;
using namespace clothlab::test;
using timeline::DistanceSample;

namespace {

std::vector<double> largest(const std::vector<DistanceSample>& samples) {
    std::vector<double> all;
    for (const DistanceSample& sample : samples)
        all.push_back(sample.distance.max);
    return all;
}

std::vector<double> computed_here(const timeline::Timeline& timeline, timeline::BranchId a, timeline::BranchId b) {
    timeline::Comparison comparison(timeline, a, b);
    while (comparison.advance())
        ;
    return largest(comparison.samples());
}

app::ComparisonJob::Result finished(app::ComparisonJob& job) {
    job.finish();
    return job.latest();
}

} // namespace

TEST_CASE("The background's curve is the one computed here, of whatever pair was asked for last", "[threads]") {
    Branches made(30, 5, 0.3, 20);
    const timeline::Timeline& all = made.player.timeline();
    app::ComparisonJob job;
    CHECK(finished(job).samples == nullptr);
    job.compare(all, made.stiff, made.soft);
    const auto first = finished(job);
    REQUIRE(first.samples);
    CHECK(first.a == made.stiff);
    CHECK(first.b == made.soft);
    CHECK(first.progress == 1);
    CHECK(first.error.empty());
    CHECK(largest(*first.samples) == computed_here(all, made.stiff, made.soft));

    for (int i = 0; i < 20; ++i) { // the one under way is given up
        job.compare(all, made.soft, made.stiff);
        job.compare(all, made.stiff, made.stiff);
    }
    const auto itself = finished(job);
    CHECK(itself.b == made.stiff);
    CHECK(largest(*itself.samples) == computed_here(all, made.stiff, made.stiff));
    job.compare(all, made.soft, made.stiff);
    CHECK(largest(*finished(job).samples) == computed_here(all, made.soft, made.stiff));

    job.stop();
    CHECK(job.latest().samples == nullptr);
    CHECK(finished(job).a == 0);
    job.compare(all, made.stiff, 99);
    CHECK(finished(job).samples->empty());
    job.compare(all, made.stiff, made.soft); // and is not waited for
}

TEST_CASE("A newer timeline lengthens the curve, which keeps what it has", "[threads]") {
    Branches made(30, 5, 0.3, 12);
    app::ComparisonJob job;
    job.compare(made.player.timeline(), made.soft, made.stiff);
    const auto before = finished(job);
    REQUIRE(before.samples->size() == 8);
    made.play(6);
    const auto whole = computed_here(made.player.timeline(), made.soft, made.stiff);
    // The beginning can no longer be reached: computed anew, the curve would not have it.
    timeline::Timeline later = made.player.timeline();
    Branches::store_every_frame(later, made.soft);
    std::erase_if(later.find(made.soft)->keyframes, [](const timeline::Keyframe& k) { return k.step < 40; });
    REQUIRE(computed_here(later, made.soft, made.stiff).size() < whole.size());
    job.compare(later, made.soft, made.stiff);
    CHECK(largest(*finished(job).samples) == whole);
    CHECK(largest(*before.samples).size() == 8); // who holds the old one still has it

    job.stop(); // forgets it
    job.compare(later, made.soft, made.stiff);
    CHECK(largest(*finished(job).samples) == computed_here(later, made.soft, made.stiff));
}
