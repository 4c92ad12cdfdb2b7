// The real lab without a display, driven by ImGui's test engine: what a user does with mouse and keys.
#pragma once

#include <imgui_test_engine/imgui_te_context.h>
#include <imgui_test_engine/imgui_te_engine.h>

#include <filesystem>
#include <functional>
#include <memory>

#include "app/core/data_folder.h"
#include "app/lab_app.h"
#include "scene/io.h"
#include "ui/camera.h"

namespace clothlab::test {

class LabDriver {
public:
    explicit LabDriver(const std::string& scene = "sphere-medium", int width = 1280, int height = 800,
                       bool keep_layout = false)
        : LabDriver(scene, options(width, height, keep_layout)) {}
    LabDriver(const std::string& scene, const app::LabOptions& options) {
        const auto file = app::scene_path(scene);
        app_ = std::make_unique<app::LabApp>(options, scene::load_scene(file), file);
        engine_ = ImGuiTestEngine_CreateContext();
        ImGuiTestEngineIO& io = ImGuiTestEngine_GetIO(engine_);
        io.ConfigRunSpeed = ImGuiTestRunSpeed_Fast;
        io.ConfigNoThrottle = true;
        io.ConfigLogToTTY = true;
        io.ConfigVerboseLevel = ImGuiTestVerboseLevel_Error;
        io.ConfigVerboseLevelOnError = ImGuiTestVerboseLevel_Error;
        ImGuiTestEngine_Start(engine_, app_->imgui());
        settle();
    }
    ~LabDriver() {
        ImGuiTestEngine_Stop(engine_);
        app_.reset();
        ImGuiTestEngine_DestroyContext(engine_);
    }
    LabDriver(const LabDriver&) = delete;
    LabDriver& operator=(const LabDriver&) = delete;

    static app::LabOptions options(int width, int height, bool keep_layout = false) {
        app::LabOptions options;
        options.window = app::Window::Kind::offscreen;
        options.width = width;
        options.height = height;
        options.keep_layout = keep_layout;
        options.scale = 1;
        return options;
    }

    /// Lets a user act; true when every widget was found and every action could be done. False when the lab was closed
    /// meanwhile.
    bool act(std::function<void(ImGuiTestContext*)> user) {
        ImGuiTest* test = IM_REGISTER_TEST(engine_, "lab", "act");
        test->UserData = &user;
        test->TestFunc = [](ImGuiTestContext* context) {
            (*static_cast<std::function<void(ImGuiTestContext*)>*>(context->Test->UserData))(context);
        };
        ImGuiTestEngine_QueueTest(engine_, test);
        while (!ImGuiTestEngine_IsTestQueueEmpty(engine_))
            if (!frame())
                return false;
        const bool done = test->Output.Status == ImGuiTestStatus_Success;
        ImGuiTestEngine_UnregisterTest(engine_, test);
        settle();
        return done;
    }

    /// False once the lab is closed.
    bool frame() {
        const bool open = app_->frame();
        if (open && after_frame)
            after_frame();
        ImGuiTestEngine_PostSwap(engine_);
        return open;
    }
    /// Until the simulation has done what it was asked for, the camera is where it was sent, and the panels show it.
    void settle() {
        ui::finish_flight(lab());
        frame();
        app_->simulation().finish();
        for (int i = 0; i < 3; ++i)
            frame();
    }

    std::function<void()> after_frame; ///< is called when a frame has been drawn

    app::LabApp& app() { return *app_; }
    ui::Lab& lab() { return app_->lab(); }

private:
    std::unique_ptr<app::LabApp> app_;
    ImGuiTestEngine* engine_ = nullptr;
};

} // namespace clothlab::test
