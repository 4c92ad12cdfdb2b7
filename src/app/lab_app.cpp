#include "app/lab_app.h"

#include <glad/gl.h>
#include <imgui.h>

#include <algorithm>
#include <type_traits>

#include "app/core/data_folder.h"
#include "app/gui/file_dialog.h"
#include "app/scene_view.h"
#include "app/shader_list.h"
#include "app/textures.h"
#include "render/procedural.h"
#include "scene/io.h"
#include "ui/camera.h"

namespace clothlab::app {
namespace fs = std::filesystem;
namespace {

fs::path layout_file(const LabOptions& options) {
    return options.keep_layout ? user_layout_file() : fs::path();
}

std::vector<fs::path> shader_folders(const LabOptions& options) {
    std::vector<fs::path> folders{data_path("shaders")};
    if (!options.user_shaders.empty())
        folders.insert(folders.begin(), options.user_shaders);
    return folders;
}

std::vector<ui::SceneEntry> scene_entries() {
    std::vector<ui::SceneEntry> entries;
    for (const fs::path& file : shipped_scenes()) {
        try {
            const scene::Scene scene = scene::load_scene(file);
            entries.push_back({scene.name, scene.description, file});
        } catch (const scene::SceneError& e) {
            entries.push_back({file.stem().string(), e.what(), file});
        }
    }
    return entries;
}

} // namespace

LabApp::LabApp(const LabOptions& options, scene::Scene scene, fs::path file)
    : window_(options.window, options.width, options.height, "clothlab"),
      imgui_(window_, layout_file(options), data_path("imgui.ini"), options.scale), picture_(window_, imgui_),
      renderer_(shader_folders(options)),
      // On the screen smooth motion matters more than smooth edges; a picture has time.
      automatic_samples_(options.window == Window::Kind::desktop && render::software_rendering() ? 1 : 4),
      viewport_(1, 1, automatic_samples_),
      shader_desk_(renderer_, lab_, options.user_shaders, options.look_at_shaders_s), drawn_{render::wireframe_shader,
                                                                                             {}} {
    lab_.scenes = scene_entries();
    for (std::size_t i = 0; i < lab_.spring_colours.size(); ++i) {
        const glm::vec3& c = render::spring_colours[i];
        lab_.spring_colours[i] = {c.r, c.g, c.b};
    }
    lab_.has_file_dialogs = options.window == Window::Kind::desktop && FileDialog::available();
    for (const render::BuiltInTexture& texture : render::built_in_textures())
        lab_.textures.push_back({texture.name, texture.title, static_cast<scene::TextureUsage>(texture.usage)});
    window_.on_drop = [this](const std::vector<std::string>& files) {
        if (!files.empty())
            drop(files.front());
    };
    set_scene(std::move(scene), std::move(file));
}

LabApp::~LabApp() = default;

void LabApp::run() {
    using Clock = std::chrono::steady_clock;
    // Paused and untouched, the lab rests: a few frames a second keep its state fresh.
    for (double rest = 0;;) {
        const bool busy = lab_.playing || lab_.flight || pictures_.recording() || timeline_desk_.expects_news() ||
                          experiment_desk_.expects_news() || ImGui::IsAnyItemActive() || dialog_;
        const Clock::time_point begun = Clock::now();
        if (!frame(!busy ? 0.05 : idle_ ? 0.004 : rest))
            return;
        if (!render::software_rendering())
            continue; // the simulation has the processor to itself
        const double passed = std::chrono::duration<double>(Clock::now() - begun).count();
        const bool late = lab_.playing && lab_.real_time_factor > 0 && lab_.real_time_factor < 0.97 * lab_.speed;
        rest = rest_.after(std::max(passed - rest, 0.0), late);
    }
}

bool LabApp::frame(double wait_seconds) {
    window_.poll(wait_seconds);
    if (window_.should_close()) {
        if (!ui::has_unsaved_shaders(lab_) && !timeline_desk_.busy())
            return false;
        window_.keep_open();
        lab_.ask(ui::Quit{});
    }
    if (quit_)
        return false;
    take_published();
    pictures_.update();
    if (window_.minimised()) { // a recording goes on
        window_.poll(pictures_.recording() ? 0.001 : 0.05);
        return true;
    }
    poll_file_dialog();
    lab_.can_undo = history_.can_undo();
    lab_.can_redo = history_.can_redo();
    shader_desk_.update();
    imgui_.begin_frame();
    ui::draw(lab_);
    carry_out_requests();
    pass_on_edits();
    draw_viewport();
    idle_ = !picture_.draw(std::exchange(new_contents_, 0u));
    if (pictures_.wants_window())
        pictures_.take_window(picture_.read());
    picture_.show();
    set_title();
    return !quit_;
}

void LabApp::take_published() {
    const Published now = simulation_.latest();
    lab_.playing = now.playing;
    lab_.real_time_factor = now.real_time_factor;
    if (now.error != refusal_) {
        refusal_ = now.error;
        if (!refusal_.empty())
            say(true, refusal_);
    }
    if (!now.snapshot)
        return;
    timeline_desk_.update(now);
    experiment_desk_.update(now);
    follow_timeline(now);
    take_opened();
    tell_trouble(lab_.snapshot->diagnostics);
    // Nobody looks at what a hidden panel would show, and it costs as much as some hundred steps.
    // A recording rests after each frame, and would wait for it each time.
    const bool watched = lab_.report[static_cast<std::size_t>(ui::PanelId::stability)].drawn && !pictures_.recording();
    if (watched != watching_stability_)
        simulation_.watch_stability(watched);
    watching_stability_ = watched;
    tell_legend();
    const sim::SnapshotExtras wanted = extras_of(lab_.scene.look, lab_.shaders);
    const std::array quantities{wanted.quantity, wanted.second_quantity};
    if (quantities != watching_quantities_)
        simulation_.watch_quantity(wanted.quantity, wanted.second_quantity);
    watching_quantities_ = quantities;
}

void LabApp::follow_timeline(const Published& now) {
    // Parameters change by going elsewhere in time as well: the panels show those of the state shown.
    if (now.taken < told_description_ || !now.description || *now.description == passed_on_)
        return;
    lab_.scene.simulation = passed_on_ = *now.description;
    lab_.pending.reset();
    history_.follow(lab_.scene);
}

void LabApp::take_opened() {
    auto opened = timeline_desk_.take_opened();
    if (!opened)
        return;
    show_scene(std::move(opened->recording.scene), {});
    told_description_ = simulation_.adopt(std::move(opened->recording.timeline), opened->recording.at);
}

void LabApp::tell_legend() {
    const auto tell = [&](const scene::ShaderDeclaration* shader, std::string& told,
                          std::vector<std::array<float, 3>>& colours) {
        const scene::ShaderParameter* map = shader && shader->legend ? shader->find(shader->legend->map) : nullptr;
        const std::string name = map ? std::get<std::string>(value_of(lab_.scene.look, *shader, *map)) : std::string();
        if (name != told)
            colours = name.empty() ? std::vector<std::array<float, 3>>() : ramp_colours(name);
        told = name;
    };
    tell(ui::shader_in_use(lab_), legend_map_, lab_.legend_colours);
    tell(ui::shader_on_the_right(lab_), split_legend_map_, lab_.split_legend_colours);
}

void LabApp::tell_trouble(const sim::Diagnostics& d) {
    if (d.status != told_ && d.status != sim::Status::ok) {
        const bool diverged = d.status == sim::Status::diverged;
        const bool paused = diverged ? lab_.pause_on_blow_up : lab_.pause_on_jitter;
        if (diverged || paused) // jitter that nobody asked to be stopped by is the status bar's
            say(true, std::string(diverged ? "The simulation blew up" : "The cloth jitters") +
                          (paused ? "; paused: " : ": ") + d.cause + ".");
    }
    told_ = d.status;
}

void LabApp::set_scene(scene::Scene scene, fs::path file) {
    show_scene(std::move(scene), std::move(file));
    told_description_ = simulation_.start(passed_on_);
}

void LabApp::show_scene(scene::Scene scene, fs::path file) {
    timeline_desk_.restart();
    experiment_desk_.restart();
    if (!scene.camera)
        scene.camera = scene::fitting_camera(scene.simulation);
    resolve_textures(scene.look, lab_.shaders, file.parent_path());
    try {
        scene::check_shader_values(scene.look, lab_.shaders, file.string());
    } catch (const scene::SceneError& e) {
        say(true, e.what()); // the shader's default is used
    }
    lab_.scene = lab_.loaded = scene;
    lab_.file = std::move(file);
    lab_.pending.reset();
    history_.restart(scene);
    passed_on_ = scene.simulation;
}

void LabApp::drop(const fs::path& file) {
    if (!is_picture(file)) {
        lab_.ask(ui::OpenScene{file});
        return;
    }
    const scene::ShaderDeclaration* shader = ui::shader_in_use(lab_);
    const scene::ShaderParameter* parameter = shader ? parameter_for_picture(*shader, file) : nullptr;
    if (!parameter)
        return say(true,
                   file.string() + ": the shader in use takes no picture; choose Texture, Bump or another first.");
    std::error_code error;
    scene::set_value(lab_.scene.look, *shader, *parameter, fs::absolute(file, error).string());
    say(false, parameter->label + ": " + file.filename().string());
}

bool LabApp::open(const fs::path& file) {
    if (file.extension() == timeline::recording_suffix) {
        timeline_desk_.open(file);
        return true;
    }
    try {
        set_scene(scene::load_scene(file), file);
        return true;
    } catch (const std::exception& e) {
        say(true, e.what());
        return false;
    }
}

void LabApp::pass_on_edits() {
    if (lab_.scene.simulation != passed_on_) {
        try {
            scene::check(lab_.scene, "This change cannot be made");
            passed_on_ = lab_.scene.simulation;
            told_description_ = simulation_.change(passed_on_);
        } catch (const scene::SceneError& e) {
            lab_.scene.simulation = passed_on_;
            say(true, e.what());
        }
    }
    if (!ImGui::IsAnyItemActive())
        history_.settle(lab_.scene);
}

void LabApp::carry_out_requests() {
    std::vector<ui::Request> requests;
    requests.swap(lab_.requests);
    const auto go_to = [this](std::optional<scene::Scene> scene) {
        if (!scene)
            return;
        scene->camera = lab_.scene.camera;
        lab_.scene = std::move(*scene);
    };
    for (ui::Request& request : requests) {
        if (pictures_.handle(request))
            continue;
        std::visit(
            [&](auto& r) {
                using R = std::remove_reference_t<decltype(r)>;
                if constexpr (std::is_same_v<R, ui::OpenScene>)
                    open(r.file);
                else if constexpr (std::is_same_v<R, ui::SaveScene>)
                    save(r.file);
                else if constexpr (std::is_same_v<R, ui::BrowseForScene>)
                    dialog_ = std::make_unique<FileDialog>(
                        r.save ? FileDialog::Purpose::save : FileDialog::Purpose::open, lab_.file);
                else if constexpr (std::is_same_v<R, ui::BrowseForTexture>)
                    dialog_ = std::make_unique<FileDialog>(FileDialog::Purpose::texture, lab_.file),
                    texture_wanted_ = r;
                else if constexpr (std::is_same_v<R, ui::Play>)
                    simulation_.play(r.on);
                else if constexpr (std::is_same_v<R, ui::StepFrame>)
                    simulation_.step_frames(1);
                else if constexpr (std::is_same_v<R, ui::StepSubstep>)
                    simulation_.step(1);
                else if constexpr (std::is_same_v<R, ui::Restart>)
                    told_description_ = simulation_.restart(lab_.scene.simulation);
                else if constexpr (std::is_same_v<R, ui::SetSpeed>) {
                    lab_.speed = r.speed;
                    simulation_.set_speed(r.speed);
                } else if constexpr (std::is_same_v<R, ui::PauseOnTrouble>) {
                    lab_.pause_on_blow_up = r.blow_up;
                    lab_.pause_on_jitter = r.jitter;
                    simulation_.pause_on_trouble(r.blow_up, r.jitter);
                } else if constexpr (std::is_same_v<R, ui::Undo>)
                    go_to(history_.undo());
                else if constexpr (std::is_same_v<R, ui::Redo>)
                    go_to(history_.redo());
                else if constexpr (std::is_same_v<R, ui::ResetLayout>) {
                    lab_.open = ui::open_at_start;
                    imgui_.reset_layout();
                } else if constexpr (std::is_same_v<R, ui::ShaderRequest>) {
                    shader_desk_.carry_out(r);
                } else if constexpr (std::is_same_v<R, ui::TimelineRequest>) {
                    timeline_desk_.carry_out(r);
                } else if constexpr (std::is_same_v<R, ui::ExperimentRequest>) {
                    experiment_desk_.carry_out(r);
                } else if constexpr (std::is_same_v<R, ui::Quit>) {
                    const bool saved = r.drop_unsaved || !ui::has_unsaved_shaders(lab_);
                    quit_ = saved && timeline_desk_.may_quit();
                    lab_.shader_work.asking_to_quit = !saved;
                } else
                    static_assert(std::is_same_v<R, ui::TakePicture> || std::is_same_v<R, ui::Record> ||
                                  std::is_same_v<R, ui::EndRecording>); // are for pictures_
            },
            request);
    }
}

void LabApp::draw_viewport() {
    if (lab_.viewport_width < 1 || lab_.viewport_height < 1)
        return; // the panel has not been drawn yet
    Shown now{lab_.snapshot,       lab_.timeline.ghost_snapshot, lab_.scene,
              lab_.viewport_width, lab_.viewport_height,         trace_choice(lab_)};
    const bool other_shaders = shader_desk_.take_changed(), other_textures = textures_changed();
    if (now == shown_ && !other_shaders && !other_textures && lab_.viewport_texture != 0)
        return;
    viewport_.set_samples(samples_of(lab_.scene.look.multisampling, automatic_samples_));
    viewport_.resize(now.width, now.height);
    const double aspect = static_cast<double>(now.width) / now.height;
    render::Scene scene = to_render(lab_.scene, lab_.shaders, lab_.snapshot.get(), aspect);
    scene.ghost = lab_.timeline.ghost_snapshot.get();
    trace_view_.show(now.inside, scene);
    try {
        draw_report_ = renderer_.draw(scene, viewport_);
        drawn_ = {scene.options.surface.shader, scene.right ? scene.right->shader : std::string()};
        shader_desk_.tell(nullptr);
    } catch (const render::ShaderError& e) {
        // A shader that has never been right: those before it go on.
        scene.options.surface = to_surface(lab_.scene.look, lab_.shaders, drawn_.left);
        if (scene.right)
            scene.right = to_surface(lab_.scene.look, lab_.shaders, drawn_.right.empty() ? drawn_.left : drawn_.right);
        draw_report_ = renderer_.draw(scene, viewport_);
        shader_desk_.tell(&e);
    }
    shown_ = std::move(now);
    lab_.viewport_texture = new_contents_ = viewport_.texture();
    tell_textures();
}

bool LabApp::textures_changed() {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_look_at_textures_)
        return false;
    next_look_at_textures_ = now + std::chrono::milliseconds(500);
    return renderer_.refresh_textures();
}

void LabApp::tell_textures() {
    std::vector<std::string> errors = renderer_.texture_errors();
    for (const std::string& error : errors)
        if (std::find(texture_errors_.begin(), texture_errors_.end(), error) == texture_errors_.end())
            say(true, error);
    texture_errors_ = std::move(errors);
}

void LabApp::save(const fs::path& file) {
    try {
        scene::Scene saved = lab_.scene;
        relate_textures(saved.look, lab_.shaders, file.parent_path());
        scene::save_scene(saved, file);
        lab_.loaded = lab_.scene;
        lab_.file = file;
        say(false, "Saved as " + file.string());
    } catch (const scene::SceneError& e) {
        say(true, e.what());
    }
}

void LabApp::poll_file_dialog() {
    if (!dialog_ || !dialog_->ready())
        return;
    const auto purpose = dialog_->purpose();
    const auto file = dialog_->result();
    dialog_.reset();
    if (!file)
        return;
    if (purpose == FileDialog::Purpose::open)
        open(*file);
    else if (purpose == FileDialog::Purpose::texture)
        lab_.scene.look.shaders[texture_wanted_.shader][texture_wanted_.parameter] = file->string();
    else
        save(file->has_extension() ? *file : fs::path(file->string() + ".json"));
}

void LabApp::set_title() {
    window_.set_title((lab_.scene.name.empty() ? "Untitled" : lab_.scene.name) + (ui::modified(lab_) ? " *" : "") +
                      " - clothlab");
}

void LabApp::show_frame(int frame_number) {
    simulation_.finish();
    const Published now = simulation_.latest();
    const auto at = now.snapshot ? static_cast<int>(now.snapshot->frame) : 0;
    if (frame_number > at)
        simulation_.step_frames(frame_number - at);
    simulation_.finish();
    // Panels take a few frames to settle: docking, tables and scroll bars learn their sizes by being drawn. What they
    // ask the simulation for, as the stability margin once its panel is seen, is waited for.
    ui::finish_flight(lab_);
    for (int i = 0; i < 4; ++i) {
        frame();
        simulation_.finish();
    }
}

} // namespace clothlab::app
