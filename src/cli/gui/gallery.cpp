#include "cli/gui/gallery.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <csignal>
#include <cstring>
#include <deque>
#include <fstream>
#include <iostream>
#include <iterator>
#include <mutex>
#include <optional>
#include <regex>
#include <thread>

#include "app/core/data_folder.h"
#include "app/scene_view.h"
#include "app/shader_list.h"
#include "app/textures.h"
#include "app/window.h"
#include "cli/gui/crew.h"
#include "cli/gui/gallery_montage.h"
#include "cli/gui/gallery_page.h"
#include "cli/progress_bar.h"
#include "render/label.h"
#include "scene/error.h"

namespace clothlab::cli {
namespace {

namespace fs = std::filesystem;

/// What drawing, labelling and writing a picture takes, in simulated frames of a usual scene; for the progress bar.
constexpr double picture_work = 150;
constexpr int thumbnail_width = 240;

/// A figure of the table, and what becomes of it.
struct Item {
    const Section* section = nullptr;
    const Figure* figure = nullptr;
    std::vector<std::string> settings; ///< the section's, then its own
    scene::Scene scene;
    FigureResult result;
    render::Image thumbnail;
};

/// One simulation, and the figures that show it.
struct Run {
    sim::Description description;
    std::vector<Item*> items; ///< by frame
    double work() const { return items.back()->figure->frame; }
};

/// A moment of a run, ready to be drawn.
struct Moment {
    Item* item;
    sim::Snapshot snapshot;
};

void write_file(const fs::path& file, const std::string& text) {
    errno = 0;
    std::ofstream out(file, std::ios::binary);
    out << text;
    out.close();
    if (!out)
        throw std::runtime_error(file.string() + ": cannot be written: " + std::strerror(errno));
}

std::string read_file(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Makes the folder, and fails now, not after minutes of work, where nothing can be written into it.
void prepare_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        throw std::runtime_error(folder.string() + ": the folder cannot be made: " + error.message());
    const fs::path probe = folder / ".clothlab-gallery";
    write_file(probe, "");
    fs::remove(probe, error);
}

std::vector<Item> items_of(const std::vector<Section>& sections, const std::string& only) {
    std::regex pattern;
    try {
        pattern = std::regex(only);
    } catch (const std::regex_error&) {
        throw scene::SceneError("--only: '" + only + "' is not a regular expression");
    }
    std::vector<Item> items;
    bool any = false;
    for (const Section& section : sections)
        for (const Figure& figure : section.figures) {
            Item& item = items.emplace_back();
            item.section = &section;
            item.figure = &figure;
            item.settings = section.settings;
            item.settings.insert(item.settings.end(), figure.settings.begin(), figure.settings.end());
            item.result.wanted = std::regex_search(figure.name, pattern);
            any = any || item.result.wanted;
        }
    if (!any)
        throw scene::SceneError("--only: '" + only + "' is in no figure's name; names are like " +
                                (items.empty() ? "" : items.front().figure->name));
    return items;
}

/// Simulates, draws and writes; the parts that are shared between threads are at its end.
class Gallery {
public:
    Gallery(const std::vector<Section>& sections, const GalleryOptions& options)
        : sections_(sections), options_(options), items_(items_of(sections, options.only)),
          shaders_(app::read_shader_list({app::data_path("shaders")})),
          faces_{render::Typeface(app::data_path("fonts/Roboto-Regular.ttf")),
                 render::Typeface(app::data_path("fonts/Roboto-Bold.ttf"))} {}

    int draw(std::ostream& out, std::ostream& err) {
        prepare_folder(options_.folder);
        std::vector<Run> runs = load();
        {
            const app::Window window(app::Window::Kind::offscreen, options_.width, options_.height, "clothlab");
            render::Renderer renderer(render::ShaderFolders{app::data_path("shaders")});
            render::Target target(options_.width, options_.height);
            work(runs, renderer, target, err);
        }
        return finish(out, err);
    }

private:
    /// Loads the wanted figures' scenes, and joins those with the same simulation.
    std::vector<Run> load() {
        std::vector<Run> runs;
        for (Item& item : items_) {
            if (!item.result.wanted)
                continue;
            ++wanted_;
            try {
                item.scene = load_figure(*item.figure, item.settings, shaders_);
            } catch (const std::exception& e) {
                fail(item, e.what());
                continue;
            }
            const auto same = [&](const Run& r) { return r.description == item.scene.simulation; };
            auto run = std::find_if(runs.begin(), runs.end(), same);
            if (run == runs.end())
                run = runs.insert(run, Run{item.scene.simulation, {}});
            run->items.push_back(&item);
        }
        for (Run& run : runs)
            std::stable_sort(run.items.begin(), run.items.end(),
                             [](const Item* a, const Item* b) { return a->figure->frame < b->figure->frame; });
        // The longest first, so that none is left over when all others are done.
        std::stable_sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.work() > b.work(); });
        return runs;
    }

    /// Simulates and writes pictures on the crew's threads, draws on this one, whose OpenGL context it is.
    void work(std::vector<Run>& runs, render::Renderer& renderer, render::Target& target, std::ostream& err) {
        double total = picture_work * static_cast<double>(wanted_);
        for (const Run& run : runs)
            total += run.work();
        ProgressBar bar(err, total, options_.progress_bar);
        const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
        Crew crew(options_.jobs > 0 ? options_.jobs : cores);
        for (Run& run : runs)
            crew.add([this, &run] { simulate(run); });
        while (!interrupted()) {
            std::unique_lock lock(mutex_);
            changed_.wait_for(lock, std::chrono::milliseconds(100),
                              [this] { return !moments_.empty() || finished_ == wanted_; });
            bar.show(picture_work * static_cast<double>(finished_) + static_cast<double>(frames_),
                     std::to_string(finished_) + " of " + std::to_string(wanted_) + " figures");
            if (finished_ == wanted_)
                return;
            if (moments_.empty())
                continue;
            Moment moment = std::move(moments_.front());
            moments_.pop_front();
            lock.unlock();
            draw_moment(moment, renderer, target, crew);
        }
    }

    void simulate(const Run& run) {
        std::size_t next = 0;
        try {
            const auto simulation = sim::Simulation::create(run.description);
            simulation->watch(true);
            sim::Snapshot before;
            while (next < run.items.size()) {
                Item& item = *run.items[next];
                if (!step_to(item.figure->frame, *simulation, before))
                    return;
                sim::Snapshot snapshot;
                sim::SnapshotExtras extras = app::extras_of(item.scene.look, shaders_);
                extras.stability = true;
                simulation->capture(snapshot, extras);
                item.result.caption = caption(item.scene, shaders_, item.settings, snapshot, before);
                ++next; // from here on the drawing fails it
                const std::lock_guard lock(mutex_);
                moments_.push_back({&item, std::move(snapshot)});
                changed_.notify_one();
            }
        } catch (const std::exception& e) {
            for (; next < run.items.size(); ++next)
                fail(*run.items[next], e.what());
        }
    }

    /// Steps to a frame, with a snapshot of a little before it: see caption(). False when interrupted.
    bool step_to(int target, sim::Simulation& simulation, sim::Snapshot& before) {
        const double frames = caption_seconds * simulation.description().stepping.frames_per_second;
        const auto to = static_cast<std::uint64_t>(target);
        const auto from = target > frames ? to - static_cast<std::uint64_t>(frames) : 0;
        for (bool captured = false; simulation.frame() < to; ++frames_) {
            if (interrupted())
                return false;
            if (!captured && simulation.frame() >= from) {
                simulation.capture(before);
                captured = true;
            }
            simulation.step_frame();
        }
        return true;
    }

    void draw_moment(const Moment& moment, render::Renderer& renderer, render::Target& target, Crew& crew) {
        try {
            const double aspect = static_cast<double>(target.width()) / target.height();
            renderer.draw(app::to_render(moment.item->scene, shaders_, &moment.snapshot, aspect), target);
            crew.add([this, item = moment.item, picture = target.read()] { write(*item, picture); }, Crew::Turn::next);
        } catch (const std::exception& e) {
            fail(*moment.item, e.what());
        }
    }

    void write(Item& item, const render::Image& picture) {
        try {
            const Caption& c = item.result.caption;
            render::Label label{item.figure->title, {{c.parameters}, {c.look}}, scale_of(item.scene.look)};
            label.lines.push_back(c.trouble ? render::LabelLine{c.outcome, trouble_colour}
                                            : render::LabelLine{c.outcome});
            const render::Image image = render::labelled(picture, label, faces_, picture.width / 38.0);
            render::write_png(image, options_.folder / (item.figure->name + ".png"));
            item.result.width = image.width;
            item.result.height = image.height;
            const int height = std::max(1, thumbnail_width * picture.height / picture.width);
            item.thumbnail =
                render::labelled(shrunk(picture, thumbnail_width, height), {item.figure->title, {}, {}}, faces_, 13);
            item.result.drawn = true;
        } catch (const std::exception& e) {
            return fail(item, e.what());
        }
        count();
    }

    /// The legend of a heat map.
    std::optional<render::LabelScale> scale_of(const scene::Look& look) const {
        const scene::ShaderDeclaration& shader = app::find_shader(shaders_, look.shader);
        const scene::ShaderParameter* map = shader.legend ? shader.find(shader.legend->map) : nullptr;
        if (!map)
            return std::nullopt;
        const scene::ShaderLegend& legend = *shader.legend;
        const auto end = [&](const std::string& parameter) {
            return readable(scene::number_of(look, shader, parameter)) + " " + legend.unit;
        };
        const auto name = std::get<std::string>(scene::value_of(look, shader, *map));
        return render::LabelScale{legend.title + ": " + end(legend.low), end(legend.high), app::ramp_colours(name)};
    }

    void fail(Item& item, const std::string& why) {
        item.result.error = why;
        count();
    }
    void count() {
        const std::lock_guard lock(mutex_);
        ++finished_;
        changed_.notify_one();
    }

    /// The page, the overview, and what there is to say.
    int finish(std::ostream& out, std::ostream& err) {
        const std::string older = read_file(options_.folder / "index.html");
        std::vector<std::string> figures;
        std::vector<render::Image> thumbnails;
        std::size_t drawn = 0, failed = 0;
        for (Item& item : items_) {
            const Figure& figure = *item.figure;
            if (item.result.drawn || !item.result.error.empty())
                figures.push_back(figure_html(*item.section, figure, item.result, options_.width, options_.height));
            else if (std::error_code error; fs::exists(options_.folder / (figure.name + ".png"), error))
                figures.push_back(figure_of_page(older, figure.name).value_or(""));
            else
                figures.emplace_back();
            if (item.result.drawn) {
                ++drawn;
                thumbnails.push_back(std::move(item.thumbnail));
            }
            if (!item.result.error.empty()) {
                ++failed;
                err << "clothlab: figure " << figure.name << ": " << item.result.error << "\n";
            }
        }
        const fs::path page = options_.folder / "index.html";
        if (drawn > 0)
            render::write_png(montage(thumbnails, 10), options_.folder / "overview.png");
        write_file(page, gallery_page(sections_, figures));
        if (drawn + failed < wanted_)
            err << "clothlab: interrupted; " << drawn << " of " << wanted_ << " figures are drawn\n";
        out << page.string() << "\n";
        return drawn == wanted_ ? 0 : 1;
    }

    bool interrupted() const { return options_.interrupted && options_.interrupted(); }

    const std::vector<Section>& sections_;
    const GalleryOptions& options_;
    std::vector<Item> items_; ///< of all figures, in the table's order; never grows
    const std::vector<scene::ShaderDeclaration> shaders_;
    render::LabelFaces faces_;
    std::size_t wanted_ = 0;
    std::atomic<std::uint64_t> frames_ = 0; ///< simulated, of all runs

    std::mutex mutex_; ///< of what follows
    std::condition_variable changed_;
    std::deque<Moment> moments_;
    std::size_t finished_ = 0; ///< figures written or failed
};

std::atomic<bool> asked_to_stop = false;

/// A second one ends the program at once.
void on_signal(int signal) {
    asked_to_stop = true;
    std::signal(signal, SIG_DFL);
}

} // namespace

scene::Scene load_figure(const Figure& figure, const std::vector<std::string>& settings,
                         const std::vector<scene::ShaderDeclaration>& shaders) {
    scene::Scene scene = SceneArguments{figure.scene, settings}.load();
    for (const std::string* name : {&scene.look.shader, &scene.look.split.shader})
        if (const scene::ShaderDeclaration& shader = app::find_shader(shaders, *name); !shader.error.empty())
            throw scene::SceneError(shader.error);
    scene::check_shader_values(scene.look, shaders, figure.scene);
    for (const auto& [name, values] : scene.look.shaders)
        app::find_shader(shaders, name);
    app::resolve_textures(scene.look, shaders, app::scene_path(figure.scene).parent_path());
    return scene;
}

int draw_gallery(const std::vector<Section>& sections, const GalleryOptions& options, std::ostream& out,
                 std::ostream& err) {
    return Gallery(sections, options).draw(out, err);
}

int gallery(const GalleryArguments& arguments) {
    static_assert(std::atomic<bool>::is_always_lock_free); // a signal may write it
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
    GalleryOptions options;
    options.folder = arguments.folder;
    options.only = arguments.only;
    options.width = arguments.width;
    options.height = arguments.height;
    options.jobs = arguments.jobs;
    std::error_code error; // a terminal, or a device such as null, where a bar does no harm
    options.progress_bar = fs::is_character_file("/dev/stderr", error);
    options.interrupted = [] { return asked_to_stop.load(); };
    return draw_gallery(gallery_sections(), options, std::cout, std::cerr);
}

} // namespace clothlab::cli
