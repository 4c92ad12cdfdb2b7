// How often the window is drawn while the simulation works: a measurement, not run by default.
//     build/clothlab_gui_tests "[frame-rate]"                   with the driver that there is
//     GALLIUM_NOOP=1 build/clothlab_gui_tests "[frame-rate]"    Mesa without rasterising: what the window itself costs
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <chrono>
#include <iostream>

#include "app/core/data_folder.h"
#include "app/lab_app.h"
#include "scene/io.h"

namespace clothlab::test {

TEST_CASE("Measure the window's frame rate while a cloth steps", "[.][frame-rate]") {
    for (const int points : {50, 150, 200}) {
        app::LabOptions options;
        options.window = app::Window::Kind::offscreen;
        options.keep_layout = false;
        const auto file = app::scene_path("sphere-medium");
        scene::Scene scene = scene::load_scene(file);
        scene.simulation.cloth.num_width_points = scene.simulation.cloth.num_height_points = points;
        // As a window on the screen of a machine that draws on its CPU has it.
        scene.look.multisampling = scene::Multisampling::off;
        scene.look.shader = "blinn-phong";
        app::LabApp app(options, scene, file);
        app.show_frame(0);
        app.simulation().play(true);

        using Clock = std::chrono::steady_clock;
        const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
        const Clock::time_point start = Clock::now();
        int frames = 0, pictures = 0;
        double slowest = 0;
        while (seconds(Clock::now() - start) < 3) {
            const Clock::time_point before = Clock::now();
            const auto shown = app.lab().snapshot;
            app.frame();
            pictures += app.lab().snapshot != shown ? 1 : 0;
            slowest = std::max(slowest, seconds(Clock::now() - before));
            ++frames;
        }
        std::cout << points << " x " << points << ": " << static_cast<int>(pictures / seconds(Clock::now() - start))
                  << " pictures of the cloth/s in " << static_cast<int>(frames / seconds(Clock::now() - start))
                  << " frames/s, slowest " << 1e3 * slowest << " ms, simulation at " << app.lab().real_time_factor
                  << " of real time" << std::endl;
        CHECK(app.lab().snapshot->steps > 0);
    }
}

} // namespace clothlab::test
