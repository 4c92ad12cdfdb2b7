#include "cli/gui/gui_commands.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "app/core/data_folder.h"
#include "app/ghost_view.h"
#include "app/gui/chart_picture.h"
#include "app/gui/film.h"
#include "app/gui/picture_sequence.h"
#include "app/lab_app.h"
#include "app/picture_maker.h"
#include "app/scene_view.h"
#include "app/shader_list.h"
#include "app/textures.h"
#include "cli/gui/gallery.h"
#include "cli/gui/scene_grid.h"
#include "scene/io.h"
#include "sim/simulation.h"

namespace clothlab::cli {
namespace {

/// What the lab shows when no scene is named.
constexpr const char* first_scene = "sphere-medium";
/// Where the cloth of most scenes has come to rest.
constexpr int draped_frame = 180;

int lab(const LabArguments& given) {
    LabArguments arguments = given;
    if (arguments.scene.scene.empty())
        arguments.scene.scene = first_scene;
    scene::Scene scene = arguments.scene.load();
    if (arguments.latitude_lines > 0)
        scene.look.sphere_latitude_lines = arguments.latitude_lines;
    if (arguments.longitude_lines > 0)
        scene.look.sphere_longitude_lines = arguments.longitude_lines;
    const auto file = app::scene_path(arguments.scene.scene);
    try {
        app::LabOptions options;
        options.user_shaders = app::user_shader_folder();
        app::LabApp window(options, scene, file);
        window.simulation().play(true);
        window.run();
        return 0;
    } catch (const app::NoDisplay& e) {
        std::cerr << "clothlab: there is no display (" << e.what() << "); drawing the lab into " << arguments.picture
                  << "\n";
    }
    app::LabOptions options;
    options.window = app::Window::Kind::offscreen;
    options.keep_layout = false;
    options.user_shaders = app::user_shader_folder();
    app::LabApp picture(options, std::move(scene), file);
    picture.show_frame(draped_frame);
    render::write_png(picture.picture(), arguments.picture);
    std::cout << arguments.picture << "\n";
    return 0;
}

/// The frames of a scene as pictures, one after the other: the whole lab, or its viewport alone.
class Camera {
public:
    virtual ~Camera() = default;
    virtual render::Image picture(int frame) = 0;
};

class LabCamera final : public Camera {
public:
    LabCamera(const RenderArguments& a, scene::Scene scene)
        : lab_(options(a), std::move(scene), app::scene_path(a.scene.scene)) {}
    render::Image picture(int frame) override {
        lab_.show_frame(frame);
        return lab_.picture();
    }

private:
    static app::LabOptions options(const RenderArguments& a) {
        app::LabOptions options;
        options.window = app::Window::Kind::offscreen;
        options.width = a.width;
        options.height = a.height;
        options.keep_layout = false;
        options.user_shaders = app::user_shader_folder();
        return options;
    }
    app::LabApp lab_;
};

/// What a ghost is a run of. Throws SceneError.
std::optional<sim::Description> ghost_of(const RenderArguments& a, scene::Scene scene) {
    if (a.ghost.empty())
        return {};
    for (const std::string& setting : a.ghost)
        if (setting.starts_with("look.") || setting.starts_with("camera."))
            throw scene::SceneError("--ghost " + setting + ": a ghost differs in its simulation alone; write --set");
    apply(a.ghost, "--ghost", scene);
    scene::check(scene, a.scene.scene);
    return scene.simulation;
}

class SceneCamera final : public Camera {
public:
    SceneCamera(const RenderArguments& a, scene::Scene scene)
        : scene_(std::move(scene)), window_(app::Window::Kind::offscreen, a.width, a.height, "clothlab"),
          shaders_(app::read_shader_list(app::shader_folders())), renderer_(app::shader_folders()),
          maker_(renderer_, a.width, a.height, app::samples_of(scene_.look.multisampling, 4), a.transparent),
          simulation_(sim::Simulation::create(scene_.simulation)) {
        if (const auto other = ghost_of(a, scene_))
            ghost_ = sim::Simulation::create(*other);
    }
    render::Image picture(int frame) override {
        while (simulation_->frame() < static_cast<std::uint64_t>(frame))
            simulation_->step_frame();
        auto snapshot = std::make_shared<sim::Snapshot>();
        simulation_->capture(*snapshot, app::extras_of(scene_.look, shaders_));
        if (ghost_) {
            const double half_a_step = sim::step_length(ghost_->description()) / 2;
            while (ghost_->time() < simulation_->time() - half_a_step)
                ghost_->step();
            ghost_->capture(ghost_snapshot_);
        }
        const sim::Snapshot* ghost = ghost_ ? &ghost_snapshot_ : nullptr;
        render::Image image =
            maker_.draw(scene_, shaders_, app::compare_with_ghost(snapshot, ghost).snapshot.get(), ghost);
        // The lab goes on with a stand-in for a picture that is missing; here nobody would notice.
        if (const std::vector<std::string> errors = renderer_.texture_errors(); !errors.empty())
            throw std::runtime_error(errors.front());
        return image;
    }

private:
    scene::Scene scene_;
    app::Window window_;
    std::vector<scene::ShaderDeclaration> shaders_;
    render::Renderer renderer_;
    app::PictureMaker maker_;
    std::unique_ptr<sim::Simulation> simulation_, ghost_;
    sim::Snapshot ghost_snapshot_;
};

void draw_frames(const RenderArguments& a, Camera& camera, int every, app::PictureSink& sink) {
    for (int frame = a.from; frame <= a.frame; frame += every)
        sink.add(camera.picture(frame));
    sink.finish();
}

void film(const RenderArguments& a, Camera& camera, double frames_per_second) {
    // At the scene's own pace, unless both say otherwise.
    const double wished = a.fps.value_or(30);
    const int every = a.every.value_or(std::max(1, static_cast<int>(std::lround(frames_per_second / wished))));
    const double rate = a.every && a.fps ? *a.fps : frames_per_second / every;
    app::Film film(a.output, a.width, a.height, rate);
    draw_frames(a, camera, every, film);
}

/// Throws SceneError for what does not go together.
void check_output(const RenderArguments& a) {
    const std::string extension = std::filesystem::path(a.output).extension().string();
    if (extension != ".png" && extension != ".mp4")
        throw scene::SceneError("-o " + a.output + ": write FILE.png for a picture or FILE.mp4 for a film");
    const bool film = extension == ".mp4", sequence = !film && app::SequenceName::is_pattern(a.output);
    if (sequence) {
        try {
            const app::SequenceName name(a.output);
        } catch (const std::runtime_error& e) {
            throw scene::SceneError(std::string("-o ") + e.what());
        }
    }
    if (!film && !sequence && (a.from > 0 || a.every))
        throw scene::SceneError(
            "--from and --every are for films and sequences: write -o FILE.mp4 or -o NAME-%04d.png");
    if (!film && a.fps)
        throw scene::SceneError("--fps is for films: write -o FILE.mp4");
    if (a.from > a.frame)
        throw scene::SceneError("--from " + std::to_string(a.from) + " is after the last frame, --frame " +
                                std::to_string(a.frame));
    if (!a.ghost.empty() && a.ui)
        throw scene::SceneError("--ghost: the lab's ghosts are its own branches; leave out --ui");
    if (a.transparent && (film || a.ui))
        throw scene::SceneError(film ? "--transparent: films have no transparency; write -o NAME-%04d.png"
                                     : "--transparent: the lab's panels have a background; leave out --ui");
}

int render(const RenderArguments& a) {
    check_output(a);
    scene::Scene scene = a.scene.load();
    if (!a.camera.empty())
        scene.camera = scene::read_camera(scene::read_text_file(a.camera), a.camera);
    if (!a.shader.empty())
        scene.look.shader = a.shader;
    const std::vector<scene::ShaderDeclaration> shaders = app::read_shader_list(app::shader_folders());
    app::find_shader(shaders, scene.look.shader);
    if (scene.look.split.on)
        app::find_shader(shaders, scene.look.split.shader);
    scene::check_shader_values(scene.look, shaders, a.scene.scene);
    app::resolve_textures(scene.look, shaders, app::scene_path(a.scene.scene).parent_path());
    const double frames_per_second = scene.simulation.stepping.frames_per_second;
    std::unique_ptr<Camera> camera;
    if (a.ui)
        camera = std::make_unique<LabCamera>(a, std::move(scene));
    else
        camera = std::make_unique<SceneCamera>(a, std::move(scene));
    if (std::filesystem::path(a.output).extension() == ".mp4") {
        film(a, *camera, frames_per_second);
    } else if (app::SequenceName::is_pattern(a.output)) {
        app::PictureSequence sequence{app::SequenceName(a.output)};
        draw_frames(a, *camera, a.every.value_or(1), sequence);
    } else {
        ::clothlab::render::write_png(camera->picture(a.frame), a.output);
    }
    std::cout << a.output << "\n";
    return 0;
}

void draw_chart(const experiments::Chart& chart, const std::string& file, int width, int height) {
    const app::Window window(app::Window::Kind::offscreen, width, height, "clothlab");
    ::clothlab::render::write_png(app::chart_picture(chart, width, height), file);
}

} // namespace

GuiCommands gui_commands() {
    GuiCommands commands;
    commands.lab = lab;
    commands.render = render;
    commands.textures = textures;
    commands.list_textures = list_textures;
    commands.gallery = gallery;
    commands.check_look = check_look;
    commands.draw_chart = draw_chart;
    commands.draw_grid = draw_scene_grid;
    return commands;
}

} // namespace clothlab::cli
