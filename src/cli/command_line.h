// The command line: what it accepts, and what each subcommand does. Results go to standard output, everything else to
// standard error; exit status 0 is success, 1 a failure of the run, 2 a usage or input error.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/chart.h"
#include "scene/scene.h"

namespace clothlab::cli {

/// A scene and the parameters that the command line sets on top of it.
struct SceneArguments {
    std::string scene;
    std::vector<std::string> settings; ///< KEY=VALUE
    /// Reads the scene and applies the settings. Throws scene::SceneError.
    scene::Scene load() const;
    /// Applies the settings to a scene of another origin, which `source` names. Throws scene::SceneError.
    void apply(scene::Scene& scene, const std::string& source) const;
};

/// Sets parameters of a scene, each KEY=VALUE. `option` is the one they came with, for what is wrong with them. Throws
/// scene::SceneError.
void apply(const std::vector<std::string>& settings, const std::string& option, scene::Scene& scene);

/// Reads WIDTHxHEIGHT, the value of --size. Throws scene::SceneError.
void read_size(const std::string& size, int& width, int& height);

struct LabArguments {
    SceneArguments scene;
    int latitude_lines = 0, longitude_lines = 0; ///< of drawn spheres; 0: as the scene says
    std::string picture = "clothlab.png";        ///< where the lab draws itself when there is no display
};

struct RenderArguments {
    SceneArguments scene;
    int frame = 90;
    int width = 1280, height = 720;
    std::string shader; ///< empty: as the scene says
    std::string camera; ///< file; empty: as the scene says
    bool ui = false;    ///< the whole lab, not the viewport alone
    std::string output; ///< .png, .png with a place for a number, or .mp4
    /// KEY=VALUE: the same scene with these parameters besides is drawn over it as a ghost; empty: none.
    std::vector<std::string> ghost;
    bool transparent = false;
    int from = 0;              ///< the first frame of a film or a sequence; frame is the last
    std::optional<int> every;  ///< simulated frames from one picture to the next
    std::optional<double> fps; ///< pictures per second of film
};

struct RunArguments {
    SceneArguments scene;
    std::optional<int> frames;
    std::optional<double> seconds;
    int threads = 1;
    std::string instructions = "auto"; ///< name of an instruction set
    std::string csv, obj, state, record;
    std::string resume;    ///< a state or a recording
    std::optional<int> at; ///< the recording's frame
    int every = 1;
    bool hash = false, json = false;
};

struct ExportArguments {
    std::string recording, folder;
    std::string frames; ///< FIRST:LAST, either left out or both; empty: all
    int every = 1;
    std::string format = "obj";
    std::string branch; ///< its name; empty: the one that was shown
};

struct BenchArguments {
    std::vector<int> sizes, threads; ///< empty: the usual ones
    std::string filter;
    bool quick = false, json = false;
};

struct TexturesArguments {
    std::string output; ///< folder
};

/// A texture that clothlab brings along.
struct TextureRow {
    std::string name, usage, title;
};

struct GalleryArguments {
    std::string folder = "gallery";
    std::string only;              ///< regular expression; empty: all figures
    int width = 800, height = 600; ///< of the pictures without their labels
    int jobs = 0;                  ///< 0: one for each core
};

/// Pictures of many runs in one, row by row, with labels above the columns and left of the rows.
struct SceneGrid {
    struct Cell {
        scene::Scene scene;
        std::uint64_t frame = 0; ///< that is drawn; of a run that diverges before, the one in which it does
        std::string caption;     ///< a line below the picture
        std::string trouble;     ///< what went wrong, in another colour behind the caption; empty: nothing
    };
    std::string source;      ///< the scene's, for people and for files that it names
    std::size_t columns = 1; ///< cells in a row
    std::vector<std::string> column_labels, row_labels;
    std::vector<Cell> cells;
    std::string file;              ///< PNG
    int width = 320, height = 240; ///< of each picture in px
    int jobs = 0;                  ///< runs at a time; 0: one for each core
};

/// What needs a GUI, given by the program that has one. Those that return a number return the exit status.
struct GuiCommands {
    std::function<int(const LabArguments&)> lab;
    std::function<int(const RenderArguments&)> render;
    std::function<int(const TexturesArguments&)> textures;
    std::function<std::vector<TextureRow>()> list_textures;
    std::function<int(const GalleryArguments&)> gallery;
    /// Draws a chart into a PNG file of a size in px. Throws scene::SceneError when it cannot be written.
    std::function<void(const experiments::Chart&, const std::string& file, int width, int height)> draw_chart;
    std::string command = {}; ///< as it was typed, for reports: run_program's own
    /// Throws scene::SceneError for a scene whose look cannot be drawn; `source` begins the sentence.
    std::function<void(const scene::Scene&, const std::string& source)> check_look;
    /// Throws scene::SceneError for a scene whose look cannot be drawn, std::runtime_error for a file that cannot be
    /// written.
    std::function<void(const SceneGrid&)> draw_grid;
};

int run_program(int argc, const char* const* argv, const GuiCommands& gui);

int run(const RunArguments& arguments);
int export_meshes(const ExportArguments& arguments);
int bench(const BenchArguments& arguments);
int validate(const std::vector<std::string>& files);
int list(const std::string& what, bool json, const GuiCommands& gui);

} // namespace clothlab::cli
