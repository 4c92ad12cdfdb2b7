// The lab: owns window, simulation thread, renderer and panels, and carries out what the panels ask for.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/core/history.h"
#include "app/core/picture_rest.h"
#include "app/core/simulation_thread.h"
#include "app/experiment_desk.h"
#include "app/gui/imgui_layer.h"
#include "app/gui/shader_desk.h"
#include "app/gui/window_picture.h"
#include "app/pictures.h"
#include "app/timeline_desk.h"
#include "app/trace_view.h"
#include "app/window.h"
#include "render/renderer.h"
#include "ui/lab.h"

namespace clothlab::app {

class FileDialog;

struct LabOptions {
    Window::Kind window = Window::Kind::desktop;
    int width = 1440, height = 900; ///< of the window, in screen coordinates
    bool keep_layout = true;        ///< load and save the user's layout; otherwise the default one is used
    float scale = 0;                ///< of the interface; 0: as the display says
    /// Searched for shaders before those that the program comes with; changed ones are saved there. Empty: none.
    std::filesystem::path user_shaders;
    double look_at_shaders_s = 0.25; ///< how often shader files are looked at for changes
};

class LabApp {
public:
    /// Opens the lab on a scene. Throws NoDisplay or std::runtime_error when there is no window to be had.
    LabApp(const LabOptions& options, scene::Scene scene, std::filesystem::path file);
    ~LabApp();

    /// Runs until the user closes the window.
    void run();

    /// One frame: events, panels, what they asked for, picture. False when the lab is to be closed.
    bool frame(double wait_seconds = 0);

    /// Steps the simulation to a frame and shows it, without haste: for pictures.
    void show_frame(int frame);
    /// The whole window as it was last drawn; only offscreen, where there is no screen to look at.
    render::Image picture() { return picture_.read(); }

    /// Opens a scene file. One that is wrong leaves everything as it was, and the lab says why; then false.
    bool open(const std::filesystem::path& file);
    /// What the user dropped onto the window: a scene is opened, a picture becomes a texture of the shader in use.
    void drop(const std::filesystem::path& file);

    ui::Lab& lab() { return lab_; }
    const render::DrawReport& draw_report() const { return draw_report_; }
    SimulationThread& simulation() { return simulation_; }
    ImGuiContext* imgui() const { return imgui_.context(); }

private:
    void set_scene(scene::Scene scene, std::filesystem::path file);
    void show_scene(scene::Scene scene, std::filesystem::path file);
    void take_opened();
    void follow_timeline(const Published& now);
    void take_published();
    void tell_legend();
    void tell_trouble(const sim::Diagnostics& diagnostics);
    void pass_on_edits();
    void carry_out_requests();
    void draw_viewport();
    bool textures_changed();
    void tell_textures();
    void save(const std::filesystem::path& file);
    void poll_file_dialog();
    void set_title();
    void say(bool error, std::string text) { lab_.messages.push_back({error, std::move(text)}); }

    Window window_;
    ImGuiLayer imgui_;
    WindowPicture picture_;
    render::Renderer renderer_;
    int automatic_samples_;
    render::Target viewport_;
    SimulationThread simulation_;
    ui::Lab lab_;
    ShaderDesk shader_desk_;
    struct {
        std::string left, right;
    } drawn_; ///< the last shaders of the picture that could be drawn with
    History history_;
    sim::Description passed_on_;         ///< what the simulation thread has been told
    std::uint64_t told_description_ = 0; ///< the ticket of that
    std::string refusal_;                ///< the simulation's last error that has been shown
    sim::Status told_ = sim::Status::ok; ///< what the user knows of the run's health
    bool watching_stability_ = false;
    std::string legend_map_, split_legend_map_; ///< whose colours lab_.legend_colours and the other ones are
    std::array<sim::PointQuantity, 2> watching_quantities_{};

    // What the viewport shows; while all of it stays the same, it is not drawn again.
    struct Shown {
        std::shared_ptr<const sim::Snapshot> snapshot, ghost;
        scene::Scene scene;
        int width = 0, height = 0;
        TraceChoice inside; ///< of a step
        bool operator==(const Shown&) const = default;
    };
    Shown shown_;
    TraceView trace_view_;
    std::chrono::steady_clock::time_point next_look_at_textures_{};
    std::vector<std::string> texture_errors_; ///< that the user has been told of
    render::DrawReport draw_report_;
    std::unique_ptr<FileDialog> dialog_;
    TimelineDesk timeline_desk_{simulation_, lab_};
    ExperimentDesk experiment_desk_{simulation_, renderer_, lab_};
    Pictures pictures_{renderer_, simulation_, lab_};
    ui::BrowseForTexture texture_wanted_; ///< what the dialog is for
    unsigned new_contents_ = 0;           ///< the viewport's texture, when it was drawn into for this frame
    bool idle_ = false;                   ///< the last frame showed nothing new
    PictureRest rest_;
    bool quit_ = false;
};

} // namespace clothlab::app
