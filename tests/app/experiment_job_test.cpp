#include "app/core/experiment_job.h"

#include <catch2/catch_test_macros.hpp>
#include <chrono>
#include <stdexcept>

using namespace clothlab;
using app::ExperimentJob;

namespace {

ExperimentJob::Result wait_for(ExperimentJob& job) {
    for (;;) {
        if (auto result = job.take_result())
            return *result;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

experiments::Findings named(const std::string& title) {
    experiments::Findings findings;
    findings.title = title;
    return findings;
}

} // namespace

TEST_CASE("An experiment's findings arrive once, and then another one may begin", "[threads]") {
    ExperimentJob job;
    CHECK_FALSE(job.status());
    for (const std::string title : {"first", "second"}) {
        std::atomic<bool> go = false;
        REQUIRE(job.start([&](const experiments::Progress& progress) {
            progress.tell(0.25, "half of a half");
            while (!go)
                std::this_thread::yield();
            return named(title);
        }));
        CHECK_FALSE(job.start([](const experiments::Progress&) { return named("beside it"); }));
        while (job.status()->share == 0)
            std::this_thread::yield();
        CHECK(job.status()->what == "half of a half");
        CHECK_FALSE(job.take_result());
        go = true;
        CHECK(wait_for(job).findings->title == title);
        CHECK_FALSE(job.take_result());
        CHECK_FALSE(job.status());
    }
}

TEST_CASE("A cancelled experiment ends without findings and without an error", "[threads]") {
    ExperimentJob job;
    REQUIRE(job.start([](const experiments::Progress& progress) -> experiments::Findings {
        for (;;)
            progress.tell(0, "for ever");
    }));
    job.cancel();
    const ExperimentJob::Result result = wait_for(job);
    CHECK_FALSE(result.findings);
    CHECK(result.error.empty());
}

TEST_CASE("Why an experiment cannot be made is told, and the lab may close in the middle of one", "[threads]") {
    ExperimentJob job;
    REQUIRE(job.start([](const experiments::Progress&) -> experiments::Findings {
        throw experiments::Refusal("the scene is chaotic");
    }));
    CHECK(wait_for(job).error == "the scene is chaotic");
    REQUIRE(job.start([](const experiments::Progress& progress) -> experiments::Findings {
        for (;;)
            progress.tell(0, "for ever");
    }));
}
