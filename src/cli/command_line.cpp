#include "cli/command_line.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <stdexcept>

#include "app/core/data_folder.h"
#include "cli/experiment/experiment.h"
#include "cli/finite.h"
#include "experiments/page.h"
#include "scene/fields.h"
#include "scene/io.h"
#include "sim/execution.h"

namespace clothlab::cli {
namespace {

constexpr int usage_error = 2;
constexpr const char* no_gui = "this clothlab was built without its GUI and cannot draw";

void add_run(CLI::App& app, RunArguments& a, int& status) {
    auto* run = app.add_subcommand("run", "Simulate a scene without a picture");
    add_scene(*run, a.scene, false);
    auto* frames =
        run->add_option("--frames", a.frames, "Frames to simulate (default: 90)")->check(CLI::NonNegativeNumber);
    run->add_option("--seconds", a.seconds, "Simulated seconds instead, rounded up to a whole frame")
        ->check(finite_non_negative)
        ->excludes(frames);
    run->add_option(
           "--threads", a.threads,
           "Threads that the simulation may use (default: 1); it measures how many are fastest. The result is the "
           "same for any number")
        ->check(CLI::Range(1, 1024));
    std::vector<std::string> sets;
    for (const sim::InstructionSetInfo& set : sim::instruction_sets())
        sets.emplace_back(set.name);
    run->add_option("--instructions", a.instructions,
                    "Instruction set to compute with (default: auto, the fastest here). The result is the same for any")
        ->check(CLI::IsMember(sets));
    run->add_option("--csv", a.csv, "Write frame,index,x,y,z to this file, frame 0 included; - is standard output");
    run->add_option("--every", a.every, "Write only every Nth frame to the CSV file")->check(CLI::PositiveNumber);
    run->add_option("--obj", a.obj, "Write the final mesh to this OBJ file");
    run->add_option("--state", a.state, "Write the final state to this file, to be resumed");
    run->add_option("--record", a.record, "Write every frame to this recording (.clothrec), to be scrubbed in the lab");
    auto* resume = run->add_option("--resume", a.resume,
                                   "Go on from the state in this file, or from a recording, bit for bit. Without a "
                                   "scene, with a recording's own parameters");
    run->add_option("--at", a.at, "The recording's frame to go on from (default: where its playhead is)")
        ->check(CLI::NonNegativeNumber)
        ->needs(resume);
    run->add_flag("--hash", a.hash, "Print only the 64-bit hash of the final state");
    run->add_flag("--json", a.json, "Print the results as one JSON object");
    run->final_callback([&a, &status] { status = cli::run(a); });
}

void add_export(CLI::App& app, ExportArguments& a, int& status) {
    auto* meshes = app.add_subcommand("export", "Write the frames of a recording as meshes, a file each");
    meshes->add_option("recording", a.recording, "Recording (.clothrec)")->required();
    meshes->add_option("-o,--output", a.folder, "The folder to write into, made where it is missing")->required();
    meshes->add_option("--frames", a.frames, "FIRST:LAST, both included; either may be left out (default: all)");
    meshes->add_option("--every", a.every, "Write only every Nth frame")->check(CLI::PositiveNumber);
    meshes->add_option("--format", a.format, "obj (default) or ply, binary and with normals")
        ->check(CLI::IsMember({"obj", "ply"}));
    meshes->add_option("--branch", a.branch, "The branch's name (default: the one that was shown)");
    meshes->final_callback([&a, &status] { status = cli::export_meshes(a); });
}

void add_render(CLI::App& app, RenderArguments& a, std::string& size, const GuiCommands& gui, int& status) {
    auto* render = app.add_subcommand("render", "Draw a scene into a PNG picture or an MP4 film");
    add_scene(*render, a.scene, true);
    render->add_option("--frame", a.frame, "The frame to draw, or the last one of a film (default: 90)")
        ->check(CLI::NonNegativeNumber);
    render->add_option("--size", size, "WIDTHxHEIGHT in pixels (default: 1280x720)");
    render->add_option("--shader", a.shader, "How the cloth is drawn (clothlab list shaders)");
    render->add_option("--camera", a.camera, "JSON file with the keys of a scene's camera");
    render
        ->add_option(
            "--ghost", a.ghost,
            "KEY=VALUE: draw the same scene with this parameter over it, see-through, at the same time; repeat "
            "for more")
        ->take_all()
        ->allow_extra_args(false);
    render->add_flag("--ui", a.ui, "Draw the whole lab, with its panels");
    render->add_flag("--transparent", a.transparent, "No background in PNG pictures");
    render->add_option("--from", a.from, "The first frame of a film or a sequence (default: 0)")
        ->check(CLI::NonNegativeNumber);
    render
        ->add_option(
            "--every", a.every,
            "Simulated frames from one picture to the next (default: 1 in a sequence; in a film as many as show "
            "it at the scene's own pace)")
        ->check(CLI::PositiveNumber);
    render
        ->add_option(
            "--fps", a.fps,
            "Pictures per second of a film (default: about 30). Without --every as near to it as whole frames at "
            "the scene's own pace allow")
        ->check(CLI::Range(0.1, 1000.0))
        ->check(finite);
    render
        ->add_option("-o,--output", a.output,
                     "FILE.png; NAME-%04d.png for a sequence, with the numbers 0, 1, 2 ...; FILE.mp4 for a film")
        ->required();
    render->final_callback([&] {
        if (!gui.render)
            throw std::runtime_error(no_gui);
        read_size(size, a.width, a.height);
        status = gui.render(a);
    });
}

void add_textures(CLI::App& app, TexturesArguments& a, const GuiCommands& gui, int& status) {
    auto* textures = app.add_subcommand("textures", "Write the textures that clothlab brings along as PNG pictures");
    textures->add_option("-o,--output", a.output, "Folder, made where it is missing")->required();
    textures->final_callback([&] {
        if (!gui.textures)
            throw std::runtime_error("this clothlab was built without its GUI and has no textures");
        status = gui.textures(a);
    });
}

void add_gallery(CLI::App& app, GalleryArguments& a, std::string& size, const GuiCommands& gui, int& status) {
    auto* gallery = app.add_subcommand("gallery", "Draw the figures of a course's write-up, and a page to read them");
    gallery->add_option("-o,--output", a.folder, "The folder to write into (default: gallery)");
    gallery->add_option("--only", a.only, "Regular expression: only figures whose names it is found in");
    gallery->add_option("--size", size,
                        "WIDTHxHEIGHT of the pictures in pixels, their labels not counted (default: 800x600)");
    gallery->add_option("--jobs", a.jobs, "Simulations at a time (default: one for each core)")
        ->check(CLI::Range(1, 1024));
    gallery->final_callback([&] {
        if (!gui.gallery)
            throw std::runtime_error(no_gui);
        if (!size.empty())
            read_size(size, a.width, a.height);
        status = gui.gallery(a);
    });
}

void add_bench(CLI::App& app, BenchArguments& a, int& status) {
    auto* bench = app.add_subcommand("bench", "Time the course's simulator against every kernel");
    bench->add_option(
        "--filter", a.filter,
        "Only runs with a match of this regular expression in CASE/SIZE/PRECISION/KERNEL/THREADS, such as "
        "falling/50/single/avx2/1, and the course's simulator beside them");
    bench
        ->add_option("--sizes", a.sizes,
                     "Points along the cloth's sides (default: 25,50,100,256,512,1024, or 50,100 with --quick)")
        ->delimiter(',')
        ->check(CLI::Range(2, 2048));
    bench->add_option("--threads", a.threads, "Numbers of threads (default: 1,2, or 1 on a machine with one core)")
        ->delimiter(',')
        ->check(CLI::Range(1, 1024));
    bench->add_flag("--quick", a.quick, "Some seconds instead of some minutes");
    bench->add_flag("--json", a.json, "Print everything that was measured as one JSON object");
    bench->final_callback([&a, &status] { status = cli::bench(a); });
}

} // namespace

void add_scene(CLI::App& app, SceneArguments& arguments, bool required) {
    auto* scene = app.add_option("scene", arguments.scene,
                                 "Scene file, or the name of one that clothlab comes with (clothlab list scenes)");
    if (required)
        scene->required();
    app.add_option("--set", arguments.settings,
                   "KEY=VALUE: set a parameter of the scene; repeat for more (clothlab list parameters)")
        ->take_all()
        ->allow_extra_args(false);
}

void read_size(const std::string& size, int& width, int& height) {
    char end = 0;
    if (std::sscanf(size.c_str(), "%dx%d%c", &width, &height, &end) != 2 || width < 1 || height < 1 || width > 16384 ||
        height > 16384)
        throw scene::SceneError("--size " + size + ": write WIDTHxHEIGHT, each from 1 to 16384");
}

scene::Scene SceneArguments::load() const {
    const std::filesystem::path file = app::scene_path(scene);
    std::error_code error;
    if (!std::filesystem::exists(file, error))
        throw scene::SceneError(scene +
                                ": there is no such file, and no scene of that name; see `clothlab list scenes`");
    scene::Scene result = scene::load_scene(file);
    apply(result, scene);
    return result;
}

void SceneArguments::apply(scene::Scene& result, const std::string& source) const {
    cli::apply(settings, "--set", result);
    scene::check(result, source);
}

void apply(const std::vector<std::string>& settings, const std::string& option, scene::Scene& scene) {
    for (const std::string& setting : settings) {
        const std::size_t equals = setting.find('=');
        if (equals == std::string::npos || equals == 0)
            throw scene::SceneError(option + " " + setting + ": write KEY=VALUE");
        scene::set_parameter(scene, std::string_view(setting).substr(0, equals),
                             std::string_view(setting).substr(equals + 1));
    }
}

int run_program(int argc, const char* const* argv, const GuiCommands& commands) {
    GuiCommands gui = commands;
    gui.command = "clothlab";
    for (int i = 1; i < argc; ++i)
        gui.command += " " + experiments::shell_word(argv[i]);
    CLI::App app("clothlab: an interactive laboratory for mass-spring cloth", "clothlab");
    app.set_version_flag("--version", "clothlab " CLOTHLAB_VERSION);
    int status = 0;

    LabArguments lab;
    add_scene(app, lab.scene, false);
    app.add_option("-f,--file", lab.scene.scene, "The same as naming the scene");
    app.add_option("-a", lab.latitude_lines, "Latitude lines of drawn spheres")->check(CLI::Range(3, 512));
    app.add_option("-o", lab.longitude_lines, "Longitude lines of drawn spheres")->check(CLI::Range(3, 512));
    app.add_option("--picture", lab.picture, "Where to draw the lab when there is no display (default: clothlab.png)");

    RunArguments run;
    add_run(app, run, status);
    ExportArguments meshes;
    add_export(app, meshes, status);
    RenderArguments render;
    std::string size = "1280x720";
    add_render(app, render, size, gui, status);
    GalleryArguments gallery;
    std::string gallery_size;
    add_gallery(app, gallery, gallery_size, gui, status);

    TexturesArguments textures;
    add_textures(app, textures, gui, status);

    BenchArguments bench;
    add_bench(app, bench, status);
    add_experiments(app, gui, status);

    std::vector<std::string> files;
    auto* validate_command =
        app.add_subcommand("validate", "Check scene files and recordings and say what is wrong with them");
    validate_command->add_option("files", files, "Scene files and recordings")->required();
    validate_command->final_callback([&] { status = validate(files); });

    std::string what;
    bool list_json = false;
    auto* list_command = app.add_subcommand("list", "List what there is");
    list_command->add_option("what", what, "integrators, shaders, textures, rules, scenes or parameters")
        ->required()
        ->check(CLI::IsMember({"integrators", "shaders", "textures", "rules", "scenes", "parameters"}));
    list_command->add_flag("--json", list_json, "As JSON");
    list_command->final_callback([&] { status = list(what, list_json, gui); });
    app.require_subcommand(0, 1);
    app.footer("Without a subcommand, clothlab opens the lab's window on the scene.");

    try {
        app.parse(argc, argv);
        if (app.get_subcommands().empty()) {
            if (!gui.lab)
                throw std::runtime_error("this clothlab was built without its GUI and has no window; see clothlab "
                                         "--help for what it can do");
            status = gui.lab(lab);
        }
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : usage_error;
    } catch (const scene::SceneError& e) {
        std::cerr << "clothlab: " << e.what() << "\n";
        return usage_error;
    } catch (const std::exception& e) {
        std::cerr << "clothlab: " << e.what() << "\n";
        return 1;
    }
    if (!std::cout.flush()) {
        std::cerr << "clothlab: standard output cannot be written\n";
        return 1;
    }
    return status;
}

} // namespace clothlab::cli
