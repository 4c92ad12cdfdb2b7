// What a draw costs on the CPU, without rasterising: a measurement, not run by default.
//     GALLIUM_NOOP=1 build/clothlab_gui_tests "[draw-cost]"
#include <algorithm>
#include <chrono>
#include <iostream>
#include <vector>

#include "gui/render_fixture.h"
#include "sim/simulation.h"

namespace clothlab::test {
namespace {

using Clock = std::chrono::steady_clock;

/// The median and the fastest of some times, in ms.
struct Cost {
    double median, least;
};

template <class Action>
Cost cost_of(Action action) {
    std::vector<double> times;
    for (int i = 0; i < 200; ++i) {
        const Clock::time_point begin = Clock::now();
        action();
        times.push_back(1e3 * std::chrono::duration<double>(Clock::now() - begin).count());
    }
    std::sort(times.begin(), times.end());
    return {times[times.size() / 2], times[0]};
}

std::ostream& operator<<(std::ostream& out, const Cost& cost) {
    return out << cost.median << " ms (least " << cost.least << ")";
}

} // namespace

TEST_CASE("Measure what a draw costs on the CPU", "[.][draw-cost]") {
    Studio studio;
    studio.target.resize(1280, 720);
    for (const int points : {50, 100, 200}) {
        sim::Description description;
        description.cloth.num_width_points = description.cloth.num_height_points = points;
        const auto simulation = sim::Simulation::create(description);
        sim::Snapshot snapshot;
        simulation->capture(snapshot);
        const std::vector<sim::Collider> colliders = {sim::Sphere{{0.5, 0.5, 0.5}, 0.3, 0}, sim::Plane{}};
        render::Scene scene = scene_of(snapshot);
        scene.colliders = colliders;
        scene.options.surface = shader_of("blinn-phong");
        // Drawn into the target and resolved, as a picture of the window is.
        const Cost anew = cost_of([&] {
            snapshot.capture = 0;
            studio.renderer.draw(scene, studio.target);
        });
        snapshot.capture = 1;
        const Cost again = cost_of([&] { studio.renderer.draw(scene, studio.target); });
        scene.options.shadow = true;
        const Cost shadow = cost_of([&] {
            snapshot.capture = 0;
            studio.renderer.draw(scene, studio.target);
        });
        std::cout << points << " x " << points << ": a new snapshot " << anew << ", with shadow " << shadow
                  << ", the same again " << again << '\n';
        CHECK(studio.renderer.draw(scene, studio.target).cloth_triangles > 0);
    }
}

} // namespace clothlab::test
