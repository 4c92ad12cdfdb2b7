// The lab with the inside of a step on show: what the simulation's thread would publish is filled in by hand.
#pragma once

#include <imgui.h>

#include <memory>
#include <string>

#include "gui/lab_driver.h"
#include "gui/small_scene.h"
#include "sim/simulation.h"
#include "ui/step_view.h"

namespace clothlab::test {

struct StepLab {
    LabDriver driver;

    /// On a small cloth that falls on a sphere.
    StepLab() : driver("two-pins", 1000, 640) {
        const TemporaryFolder folder;
        driver.app().open(small_scene(folder));
        driver.settle();
    }

    static constexpr std::size_t points = std::size_t{small_side} * small_side;
    ui::Lab& lab() { return driver.lab(); }
    ui::TimelineWork& work() { return driver.lab().timeline; }
    const sim::StepTrace& trace() { return *work().trace; }

    /// Goes on by whole frames and then by single steps.
    void go(int frames, int steps = 0) {
        driver.app().simulation().step_frames(frames);
        driver.app().simulation().step(steps);
        driver.settle();
    }
    /// Opens the panel, in a corner of the window, and shows the inside of the step that comes next.
    void look_into(ImVec2 at = {10, 30}, ImVec2 size = {720, 340}) {
        lab().open[static_cast<std::size_t>(ui::PanelId::step)] = true;
        driver.settle();
        driver.act([](ImGuiTestContext* user) { user->UndockWindow("###Inside a step"); });
        ImGui::SetWindowPos("###Inside a step", at);
        ImGui::SetWindowSize("###Inside a step", size);
        trace_again();
    }
    void trace_again() {
        const auto run = sim::Simulation::create(lab().scene.simulation);
        while (run->steps() < lab().snapshot->steps)
            run->step();
        work().trace = std::make_shared<const sim::StepTrace>(run->trace_step());
        driver.settle();
    }
    void show(sim::Stage stage) {
        work().stage = static_cast<int>(stage);
        driver.settle();
    }
    const ui::PanelReport& panel() { return lab().report[static_cast<std::size_t>(ui::PanelId::step)]; }
};

} // namespace clothlab::test
