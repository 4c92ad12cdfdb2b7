#include "cli/gui/scene_grid.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <exception>
#include <iostream>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>

#include <unistd.h>

#include "app/core/data_folder.h"
#include "app/picture_maker.h"
#include "app/scene_view.h"
#include "app/shader_list.h"
#include "app/textures.h"
#include "app/window.h"
#include "cli/gui/crew.h"
#include "cli/gui/gallery_montage.h"
#include "cli/progress_bar.h"
#include "experiments/trial.h"
#include "scene/error.h"
#include "sim/simulation.h"

namespace clothlab::cli {
namespace {

using Shaders = std::vector<scene::ShaderDeclaration>;

constexpr int gap = 6; ///< px, between pictures
constexpr render::Rgb label_colour{0xE6, 0xEA, 0xF0}, caption_colour{0xB6, 0xBE, 0xC8};

scene::Look drawable_look(const scene::Scene& scene, const std::string& source, const Shaders& shaders) {
    scene::Look look = scene.look;
    app::find_shader(shaders, look.shader);
    if (look.split.on)
        app::find_shader(shaders, look.split.shader);
    scene::check_shader_values(look, shaders, source);
    app::resolve_textures(look, shaders, app::scene_path(source).parent_path());
    return look;
}

/// A run at its end.
struct Moment {
    std::size_t cell;
    sim::Snapshot snapshot;
};

/// Runs on a crew's threads, drawn on this one, whose OpenGL context it is.
class Drawing {
public:
    Drawing(const SceneGrid& grid, const Shaders& shaders) : grid_(grid), shaders_(shaders) {
        for (const SceneGrid::Cell& cell : grid.cells) {
            scenes_.push_back(cell.scene);
            scenes_.back().look = drawable_look(cell.scene, grid.source, shaders);
        }
    }

    std::vector<render::Image> pictures() {
        const app::Window window(app::Window::Kind::offscreen, grid_.width, grid_.height, "clothlab");
        render::Renderer renderer(app::shader_folders());
        app::PictureMaker maker(renderer, grid_.width, grid_.height,
                                app::samples_of(scenes_.front().look.multisampling, 4), false);
        std::vector<render::Image> pictures(scenes_.size());
        ProgressBar bar(std::cerr, static_cast<double>(scenes_.size()), isatty(STDERR_FILENO) != 0);
        const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
        Crew crew(grid_.jobs > 0 ? grid_.jobs : cores);
        for (std::size_t cell = 0; cell < scenes_.size(); ++cell)
            crew.add([this, cell] { simulate(cell); });
        for (std::size_t drawn = 0; drawn < scenes_.size(); ++drawn) {
            bar.show(static_cast<double>(drawn),
                     std::to_string(drawn) + " of " + std::to_string(scenes_.size()) + " pictures");
            const Moment moment = next();
            pictures[moment.cell] = maker.draw(scenes_[moment.cell], shaders_, &moment.snapshot);
            if (const std::vector<std::string> errors = renderer.texture_errors(); !errors.empty())
                throw std::runtime_error(errors.front());
        }
        return pictures;
    }

private:
    void simulate(std::size_t cell) {
        Moment moment{cell, {}};
        std::exception_ptr error;
        try {
            const auto simulation = sim::Simulation::create(scenes_[cell].simulation);
            simulation->watch(true);
            experiments::run_frames(*simulation, grid_.cells[cell].frame);
            simulation->capture(moment.snapshot, app::extras_of(scenes_[cell].look, shaders_));
        } catch (...) {
            error = std::current_exception();
        }
        const std::lock_guard lock(mutex_);
        error_ = error ? error : error_;
        moments_.push_back(std::move(moment));
        changed_.notify_one();
    }

    Moment next() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return !moments_.empty(); });
        if (error_)
            std::rethrow_exception(error_);
        Moment moment = std::move(moments_.front());
        moments_.pop_front();
        return moment;
    }

    const SceneGrid& grid_;
    const Shaders& shaders_;
    std::vector<scene::Scene> scenes_; ///< of the cells, with their pictures found
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Moment> moments_;
    std::exception_ptr error_;
};

/// The text, or as much of it as fits into so many px.
std::string fitting(const render::Typeface& face, const std::string& text, double size, double most) {
    if (face.width(text, size) <= most)
        return text;
    std::string shorter = text;
    while (!shorter.empty() && face.width(shorter + "…", size) > most) {
        while (!shorter.empty() && (static_cast<unsigned char>(shorter.back()) & 0xC0) == 0x80)
            shorter.pop_back(); // the rest of a letter of several bytes
        if (!shorter.empty())
            shorter.pop_back();
    }
    return shorter + "…";
}

void place(render::Image& whole, const render::Image& part, int left, int top) {
    for (int y = 0; y < part.height; ++y) {
        const std::size_t at =
            static_cast<std::size_t>(top + y) * static_cast<std::size_t>(whole.width) + static_cast<std::size_t>(left);
        std::memcpy(&whole.rgba[4 * at], part.pixel(0, y), 4 * static_cast<std::size_t>(part.width));
    }
}

} // namespace

void check_look(const scene::Scene& scene, const std::string& source) {
    drawable_look(scene, source, app::read_shader_list(app::shader_folders()));
}

render::Image labelled_grid(const SceneGrid& grid, const std::vector<render::Image>& pictures,
                            const render::LabelFaces& faces) {
    const double size = std::clamp(grid.width / 20.0, 11.0, 22.0), small = 0.85 * size;
    const int band = static_cast<int>(2 * size), strip = static_cast<int>(1.8 * small);
    double widest = 0;
    for (const std::string& label : grid.row_labels)
        widest = std::max(widest, faces.bold.width(label, size));
    widest = std::min(widest, 1.0 * grid.width);
    const int margin = grid.row_labels.empty() ? gap : static_cast<int>(widest + size) + gap;

    const auto columns = static_cast<int>(grid.columns);
    const int rows = static_cast<int>(pictures.size()) / columns;
    const int across = grid.width + gap, down = grid.height + strip + gap;
    render::Image whole = plain_ground(margin + columns * across, band + rows * down);
    for (int column = 0; column < columns; ++column) {
        const std::string label =
            fitting(faces.bold, grid.column_labels[static_cast<std::size_t>(column)], size, grid.width);
        const double left = margin + column * across + (grid.width - faces.bold.width(label, size)) / 2;
        faces.bold.draw(whole, left, size / 2, label, size, label_colour);
    }
    for (int row = 0; row < rows; ++row) {
        const int top = band + row * down;
        if (!grid.row_labels.empty()) {
            const std::string label = fitting(faces.bold, grid.row_labels[static_cast<std::size_t>(row)], size, widest);
            faces.bold.draw(whole, size / 2, top + (grid.height - size) / 2, label, size, label_colour);
        }
        for (int column = 0; column < columns; ++column) {
            const auto i = static_cast<std::size_t>(row * columns + column);
            const SceneGrid::Cell& cell = grid.cells[i];
            const int left = margin + column * across;
            place(whole, pictures[i], left, top);
            const double line = top + grid.height + 0.4 * small;
            const std::string caption = fitting(faces.regular, cell.caption, small, grid.width);
            faces.regular.draw(whole, left, line, caption, small, caption_colour);
            const double used = caption.empty() ? 0 : faces.regular.width(caption + "  ", small);
            if (!cell.trouble.empty())
                faces.regular.draw(whole, left + used, line,
                                   fitting(faces.regular, cell.trouble, small, grid.width - used), small,
                                   trouble_colour);
        }
    }
    return whole;
}

void draw_scene_grid(const SceneGrid& grid) {
    const Shaders shaders = app::read_shader_list(app::shader_folders());
    const render::LabelFaces faces{render::Typeface(app::data_path("fonts/Roboto-Regular.ttf")),
                                   render::Typeface(app::data_path("fonts/Roboto-Bold.ttf"))};
    render::write_png(labelled_grid(grid, Drawing(grid, shaders).pictures(), faces), grid.file);
}

} // namespace clothlab::cli
