// The panels alone, without a simulation behind them: they show a lab that a test makes up, and what they ask for is
// kept instead of being carried out.
#pragma once

#include <glad/gl.h>
#include <imgui_impl_opengl3.h>
#include <imgui_test_engine/imgui_te_context.h>
#include <imgui_test_engine/imgui_te_engine.h>

#include <functional>
#include <variant>
#include <vector>

#include "app/core/data_folder.h"
#include "app/gui/imgui_layer.h"
#include "render/offscreen.h"
#include "scene/io.h"
#include "ui/lab.h"

namespace clothlab::test {

class PanelDriver {
public:
    explicit PanelDriver(int width = 1440, int height = 900, float scale = 1)
        : window_(app::Window::Kind::offscreen, width, height, "panels"),
          layer_(window_, {}, app::data_path("imgui.ini"), scale), picture_(width, height, 1) {
        lab.scene = lab.loaded = scene::load_scene(app::scene_path("sphere-medium"));
        engine_ = ImGuiTestEngine_CreateContext();
        ImGuiTestEngineIO& io = ImGuiTestEngine_GetIO(engine_);
        io.ConfigRunSpeed = ImGuiTestRunSpeed_Fast;
        io.ConfigNoThrottle = true;
        io.ConfigLogToTTY = true;
        io.ConfigVerboseLevel = ImGuiTestVerboseLevel_Error;
        io.ConfigVerboseLevelOnError = ImGuiTestVerboseLevel_Error;
        ImGuiTestEngine_Start(engine_, layer_.context());
        settle();
    }
    ~PanelDriver() { ImGuiTestEngine_Stop(engine_); }
    PanelDriver(const PanelDriver&) = delete;
    PanelDriver& operator=(const PanelDriver&) = delete;

    void frame(bool drawn = false) {
        window_.poll();
        layer_.begin_frame();
        ui::draw(lab);
        for (ui::Request& request : lab.requests)
            requests.push_back(std::move(request));
        lab.requests.clear();
        // Drawing takes most of the time, and few tests look at it: only the textures are made.
        ImGui::Render();
        ImDrawData& drawing = *ImGui::GetDrawData();
        if (!drawn) {
            drawing.CmdLists.clear();
            drawing.TotalIdxCount = drawing.TotalVtxCount = 0;
        }
        if (drawn)
            picture_.bind();
        glDisable(GL_FRAMEBUFFER_SRGB);
        ImGui_ImplOpenGL3_RenderDrawData(&drawing);
        if (drawn)
            picture_.resolve();
        ImGuiTestEngine_PostSwap(engine_);
    }
    void settle() {
        for (int i = 0; i < 4; ++i)
            frame();
    }
    /// Lets a user act; true when every widget was found and every action could be done.
    bool act(std::function<void(ImGuiTestContext*)> user) {
        requests.clear();
        ImGuiTest* test = IM_REGISTER_TEST(engine_, "panels", "act");
        test->UserData = &user;
        test->TestFunc = [](ImGuiTestContext* context) {
            (*static_cast<std::function<void(ImGuiTestContext*)>*>(context->Test->UserData))(context);
        };
        ImGuiTestEngine_QueueTest(engine_, test);
        while (!ImGuiTestEngine_IsTestQueueEmpty(engine_))
            frame();
        const bool done = test->Output.Status == ImGuiTestStatus_Success;
        ImGuiTestEngine_UnregisterTest(engine_, test);
        settle();
        return done;
    }

    /// The requests of a kind since the last act() began.
    template <class Wanted>
    std::vector<Wanted> asked() const {
        std::vector<Wanted> found;
        for (const ui::Request& request : requests) {
            std::visit(
                [&](const auto& r) {
                    using R = std::decay_t<decltype(r)>;
                    if constexpr (std::is_same_v<R, Wanted>)
                        found.push_back(r);
                    else if constexpr (std::is_same_v<R, ui::TimelineRequest>)
                        std::visit(
                            [&](const auto& t) {
                                if constexpr (std::is_same_v<std::decay_t<decltype(t)>, Wanted>)
                                    found.push_back(t);
                            },
                            r);
                },
                request);
        }
        return found;
    }
    const ui::PanelReport& report(ui::PanelId panel) const { return lab.report[static_cast<std::size_t>(panel)]; }
    render::Image picture() {
        frame(true);
        return picture_.read();
    }

    ui::Lab lab;
    std::vector<ui::Request> requests;

private:
    // The engine goes after the context that it was started on.
    struct Engine {
        ImGuiTestEngine* engine = nullptr;
        ~Engine() { ImGuiTestEngine_DestroyContext(engine); }
        operator ImGuiTestEngine*() const { return engine; }
        Engine& operator=(ImGuiTestEngine* e) {
            engine = e;
            return *this;
        }
    };
    Engine engine_;
    app::Window window_;
    app::ImGuiLayer layer_;
    render::Target picture_;
};

} // namespace clothlab::test
