// What the panels show and change. The app fills it in before a frame; panels write the scene and ask for what they
// cannot do themselves; the app does it after the frame. Panels know neither threads nor OpenGL.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "scene/shader_parameters.h"
#include "sim/snapshot.h"
#include "ui/experiment_work.h"
#include "ui/output.h"
#include "ui/shader_work.h"
#include "ui/timeline_view.h"
#include "ui/timeline_work.h"

namespace clothlab::ui {

struct SceneEntry {
    std::string name, description;
    std::filesystem::path file;
};

/// A texture that comes with the lab.
struct TextureChoice {
    std::string name, title;
    scene::TextureUsage usage;
};

// What panels ask the app for.
struct OpenScene {
    std::filesystem::path file;
};
struct SaveScene {
    std::filesystem::path file;
};
struct BrowseForScene {
    bool save = false;
}; ///< a file dialog of the system
struct BrowseForTexture {
    std::string shader, parameter;
}; ///< a file dialog of the system, for a shader's texture
struct TakePicture {
    std::filesystem::path file; ///< empty: the next free name after the last one
    bool replace = false;       ///< a file that is there already
};
struct Record {
    bool replace = false; ///< files that are there already
};
struct EndRecording {
    bool keep = true;
};
struct Play {
    bool on;
};
struct StepFrame {};
struct StepSubstep {};
struct Restart {};
struct SetSpeed {
    double speed;
};
struct PauseOnTrouble {
    bool blow_up, jitter;
};
struct Undo {};
struct Redo {};
struct ResetLayout {};
struct Quit {
    bool drop_unsaved = false; ///< shader texts; otherwise the user is asked about them
};
using Request = std::variant<OpenScene, SaveScene, BrowseForScene, BrowseForTexture, TakePicture, Record, EndRecording,
                             Play, StepFrame, StepSubstep, Restart, SetSpeed, PauseOnTrouble, Undo, Redo, ResetLayout,
                             ShaderRequest, TimelineRequest, ExperimentRequest, Quit>;

struct Message {
    bool error = false;
    std::string text;
};

/// A camera on its way: see ui/camera.h.
struct CameraFlight {
    scene::Camera from, to;
    scene::Camera at; ///< where the flight put it last
    double share = 0; ///< of the flight's time that has passed
};

/// What a panel drew in the last frame, for tests and for the headless check.
struct PanelReport {
    std::string name;
    bool drawn = false;  ///< not hidden behind another tab, not closed
    bool behind = false; ///< open, but hidden behind another tab
    float x = 0, y = 0, width = 0, height = 0;
};

enum class PanelId : std::uint8_t {
#define CLOTHLAB_PANEL(id, title, icon, at_start) id,
#include "ui/panels.def"
#undef CLOTHLAB_PANEL
    count
};
inline constexpr std::size_t panel_count = static_cast<std::size_t>(PanelId::count);

/// The panels that are open when the lab starts and in the default layout.
inline constexpr std::array<bool, panel_count> open_at_start = {
#define CLOTHLAB_PANEL(id, title, icon, at_start) at_start,
#include "ui/panels.def"
#undef CLOTHLAB_PANEL
};

struct Lab {
    scene::Scene scene;         ///< as it is now: panels write here
    scene::Scene loaded;        ///< as loaded or last saved: what reset goes back to
    std::filesystem::path file; ///< that it came from
    std::vector<SceneEntry> scenes;
    std::vector<scene::ShaderDeclaration> shaders;
    std::vector<TextureChoice> textures;

    std::shared_ptr<const sim::Snapshot> snapshot; ///< newest state; none before the first
    bool playing = false;
    double speed = 1;            ///< simulated seconds per second aimed at
    double real_time_factor = 0; ///< reached; 0 when unknown
    bool pause_on_blow_up = true, pause_on_jitter = false;
    bool can_undo = false, can_redo = false;
    bool has_file_dialogs = false;

    std::uint64_t viewport_texture = 0;          ///< shown by the viewport panel, bottom row first
    int viewport_width = 0, viewport_height = 0; ///< px that the viewport panel wants
    std::array<std::array<float, 3>, sim::spring_kinds> spring_colours{};
    std::vector<std::array<float, 3>> legend_colours;       ///< of the heat map in use, from low to high; sRGB
    std::vector<std::array<float, 3>> split_legend_colours; ///< the same of the right part of a split view
    std::string shader_before = "diffuse";                  ///< what key W goes back to
    bool show_lamps = false;                                ///< as handles in the viewport
    std::optional<CameraFlight> flight;
    Output output;

    /// A parameter that restarts the run takes effect when its slider is let go: until then the value waits here.
    struct Pending {
        std::string_view key;
        double value;
    };
    std::optional<Pending> pending;

    std::deque<Message> messages; ///< newest last; the viewport shows them until they are dismissed
    std::vector<Request> requests;
    ShaderWork shader_work;
    TimelineWork timeline;
    TimelineView timeline_view;
    ExperimentWork experiments;
    std::array<bool, panel_count> open = open_at_start;
    std::array<PanelReport, panel_count> report{};
    bool status_bar_drawn = false;

    void ask(Request request) { requests.push_back(std::move(request)); }
};

/// Whether the scene differs from what was loaded in more than its camera.
bool modified(const Lab& lab);

/// The shader that the cloth is drawn with; none when no file declares it.
const scene::ShaderDeclaration* shader_in_use(const Lab& lab);
/// The one on the right of a split view; none without one.
const scene::ShaderDeclaration* shader_on_the_right(const Lab& lab);

/// Whether the shader panel has texts that are not in their files.
bool has_unsaved_shaders(const Lab& lab);

/// Draws the menu, every open panel and the status bar, and handles the keys.
void draw(Lab& lab);

} // namespace clothlab::ui
