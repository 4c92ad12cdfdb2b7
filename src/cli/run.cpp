// `clothlab run`: a scene without a picture, and its numbers.
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "cli/command_line.h"
#include "scene/frames.h"
#include "scene/io.h"
#include "scene/number_text.h"
#include "scene/whole_file.h"
#include "sim/integrators/integrator.h"
#include "sim/intersections.h"
#include "sim/simulation.h"
#include "timeline/mesh_sequence.h"
#include "timeline/reader.h"
#include "timeline/run_recorder.h"

namespace clothlab::cli {
namespace {

using Json = nlohmann::ordered_json;

/// A file that complains, by name, when it cannot be written.
class Output {
public:
    /// Replaces the file; with std::ios::app, leaves what is in it.
    explicit Output(std::string name, std::ios::openmode mode = std::ios::trunc) : name_(std::move(name)) {
        if (name_ == "-")
            return;
        file_.open(name_, std::ios::binary | mode);
        if (!file_)
            fail();
    }
    void write(std::string_view text) { stream().write(text.data(), static_cast<std::streamsize>(text.size())); }
    void close() {
        stream().flush();
        if (!stream())
            fail();
    }

private:
    std::ostream& stream() { return name_ == "-" ? std::cout : file_; }
    [[noreturn]] void fail() const { throw std::runtime_error(name_ + ": cannot be written: " + std::strerror(errno)); }
    std::string name_;
    std::ofstream file_;
};

/// Appends a point and the end of its line.
void append(std::string& text, const sim::Vec3& p, char separator, bool single) {
    scene::append_number(text, p.x, single);
    text += separator;
    scene::append_number(text, p.y, single);
    text += separator;
    scene::append_number(text, p.z, single);
    text += '\n';
}

void write_csv_frame(Output& csv, const sim::Simulation& simulation) {
    const bool single = simulation.description().stepping.precision == sim::Precision::single_precision;
    std::string text;
    for (std::size_t i = 0; i < simulation.points(); ++i) {
        const sim::Vec3 p = simulation.position(i);
        text += std::to_string(simulation.frame()) + "," + std::to_string(i) + ",";
        append(text, p, ',', single);
    }
    csv.write(text);
}

/// "-" is standard output.
void write_whole(const std::string& name, std::string_view bytes) {
    if (name == "-") {
        std::cout.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        return;
    }
    scene::WholeFile file(name);
    file.write(bytes);
    file.commit();
}

/// What a run begins with.
struct Start {
    scene::Scene scene;
    std::string source;           ///< the scene's, for people
    std::vector<std::byte> state; ///< empty: the scene's own start
};

timeline::Recording load_recording(const std::string& file) {
    try {
        timeline::Recording recording = timeline::load_recording(file);
        if (!recording.damage.empty())
            std::cerr << "clothlab: " << recording.damage << "\n";
        return recording;
    } catch (const timeline::RecordingError& e) {
        throw scene::SceneError(e.what());
    }
}

/// The moment at a frame's end on the line that was shown.
timeline::Moment moment_at(const timeline::Recording& recording, int frame, const std::string& file) {
    const timeline::BranchId line = recording.at.branch;
    const auto number = static_cast<std::uint64_t>(frame);
    const timeline::Moment moment{line, recording.timeline.step_of_frame(line, number)};
    if (!recording.timeline.reachable(moment) || recording.timeline.frame_time(moment).frame != number)
        throw scene::SceneError("--at " + std::to_string(frame) + ": " + file + " has no such frame");
    return moment;
}

Start resumed(const RunArguments& arguments) {
    Start start;
    timeline::Recording recording = load_recording(arguments.resume);
    if (arguments.at)
        recording.at = moment_at(recording, *arguments.at, arguments.resume);
    timeline::Reader reader;
    reader.seek(recording.timeline, recording.at);
    start.state = reader.simulation().save_state();
    if (!arguments.scene.scene.empty()) {
        start.scene = arguments.scene.load();
        start.source = arguments.scene.scene;
        return start;
    }
    start.scene = std::move(recording.scene);
    start.scene.simulation = *reader.description();
    start.source = arguments.resume;
    arguments.scene.apply(start.scene, start.source);
    return start;
}

Start start_of(const RunArguments& arguments) {
    if (!arguments.resume.empty() && timeline::is_recording(arguments.resume))
        return resumed(arguments);
    if (arguments.at)
        throw scene::SceneError("--at: " + arguments.resume + " is not a recording");
    if (arguments.scene.scene.empty())
        throw scene::SceneError("name a scene, or a recording to go on from with --resume");
    Start start{arguments.scene.load(), arguments.scene.scene, {}};
    if (!arguments.resume.empty()) {
        constexpr std::uintmax_t max_size = std::uintmax_t{1}
                                            << 30; // of the largest cloth in double precision: 192 MiB
        const std::string text = scene::read_text_file(arguments.resume, max_size);
        const auto bytes = std::as_bytes(std::span(text));
        start.state.assign(bytes.begin(), bytes.end());
    }
    return start;
}

void load_state(const Start& start, const std::string& file, sim::Simulation& simulation) {
    try {
        simulation.load_state(start.state);
    } catch (const std::invalid_argument& e) {
        throw scene::SceneError(file + ": " + e.what());
    }
}

std::uint64_t frames_to_run(const RunArguments& arguments, const sim::Description& description) {
    if (arguments.frames)
        return static_cast<std::uint64_t>(*arguments.frames);
    if (!arguments.seconds)
        return 90;
    return scene::frames_of(*arguments.seconds, description);
}

std::string_view instruction_name(sim::InstructionSet set) {
    return sim::instruction_sets()[static_cast<std::size_t>(set)].name;
}

sim::Execution execution(const RunArguments& arguments) {
    sim::Execution execution{.threads = arguments.threads};
    for (const sim::InstructionSetInfo& set : sim::instruction_sets())
        if (set.name == arguments.instructions)
            execution.instructions = set.id;
    if (!sim::is_supported(execution.instructions))
        throw scene::SceneError("--instructions " + arguments.instructions + ": this machine has no such instructions");
    return execution;
}

/// Infinity is null.
Json stability(const sim::StabilityMargin& margin) {
    const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
    return {{"omega", number(margin.omega)},
            {"omega_bound", number(margin.omega_bound)},
            {"omega_dt", number(margin.omega_dt)},
            {"limit", number(margin.limit)},
            {"dt_max_s", number(margin.dt_max)},
            {"ks_max", number(margin.ks_max)},
            {"density_min", number(margin.density_min)},
            {"substeps_min", number(margin.substeps_min)}};
}

Json results(const Start& start, const sim::Simulation& simulation, std::uint64_t frames, std::uint64_t steps,
             double wall_s) {
    const sim::Stepping& stepping = simulation.description().stepping;
    sim::Snapshot snapshot;
    simulation.capture(snapshot);
    const sim::Diagnostics& d = snapshot.diagnostics;
    // Of a tangle there is no end of intersections to count, and no sense in it.
    Json intersections;
    if (d.status == sim::Status::ok)
        intersections = sim::count_intersections(snapshot.columns, snapshot.rows, snapshot.positions);
    Json stages;
    for (std::size_t i = 0; i < sim::stage_names.size(); ++i)
        stages[sim::stage_names[i]] = simulation.stage_seconds()[i];
    const bool single = stepping.precision == sim::Precision::single_precision;
    return {{"scene", start.source},
            {"name", start.scene.name},
            {"integrator", sim::integrators()[static_cast<std::size_t>(stepping.integrator)].name},
            {"precision", single ? "single" : "double"},
            {"instructions", instruction_name(simulation.instructions())},
            {"threads", simulation.threads()},
            {"frames", frames},
            {"steps", steps},
            {"simulated_s", simulation.time()},
            {"wall_s", wall_s},
            {"steps_per_s", wall_s > 0 ? static_cast<double>(steps) / wall_s : 0.0},
            {"stage_s", stages},
            {"energy_J",
             {{"kinetic", d.energy.kinetic},
              {"spring", d.energy.spring},
              {"gravity", d.energy.gravity},
              {"total", d.energy.total()}}},
            {"max_strain", d.max_strain},
            {"rms_speed", d.rms_speed},
            {"intersections", intersections},
            {"status", sim::status_names[static_cast<std::size_t>(d.status)]},
            {"cause", d.cause},
            {"stability", stability(simulation.stability())},
            {"hash", scene::hash_text(simulation.hash())}};
}

void print_fields(const Json& json, const std::string& prefix = "") {
    for (const auto& item : json.items()) {
        if (item.value().is_object()) {
            print_fields(item.value(), prefix + item.key() + ".");
            continue;
        }
        std::string key = prefix + item.key();
        key.resize(std::max<std::size_t>(key.size() + 2, 24), ' ');
        std::cout << key << (item.value().is_string() ? item.value().get<std::string>() : item.value().dump()) << "\n";
    }
}

} // namespace

int run(const RunArguments& arguments) {
    if (arguments.csv == "-" && (arguments.json || arguments.hash))
        throw scene::SceneError("--csv -: standard output can hold the rows or --json or --hash, not both");
    const Start start = start_of(arguments);
    const std::uint64_t frames = frames_to_run(arguments, start.scene.simulation);
    const bool resumes = !arguments.resume.empty();
    std::unique_ptr<sim::Simulation> own = sim::Simulation::create(start.scene.simulation, execution(arguments));
    if (resumes)
        load_state(start, arguments.resume, *own);
    // Before the work, not after it: that an output cannot be written.
    for (const std::string& file : {arguments.obj, arguments.state})
        if (!file.empty() && file != "-")
            scene::WholeFile{file};
    own->time_stages(true);
    own->watch(true);
    std::optional<timeline::RunRecorder> recorder;
    if (!arguments.record.empty()) {
        recorder.emplace(arguments.record, start.scene, execution(arguments), resumes ? &start.state : nullptr);
        own.reset();
    }
    const sim::Simulation& simulation = recorder ? recorder->simulation() : *own;
    std::optional<Output> csv;
    if (!arguments.csv.empty()) {
        csv.emplace(arguments.csv);
        csv->write("frame,index,x,y,z\n");
        write_csv_frame(*csv, simulation);
    }

    using Clock = std::chrono::steady_clock;
    double wall_s = 0;
    const std::uint64_t first_step = simulation.steps();
    for (std::uint64_t done = 1; done <= frames; ++done) {
        const auto begin = Clock::now();
        recorder ? recorder->step_frame() : own->step_frame();
        wall_s += std::chrono::duration<double>(Clock::now() - begin).count();
        if (csv && done % static_cast<std::uint64_t>(arguments.every) == 0)
            write_csv_frame(*csv, simulation);
    }
    if (csv)
        csv->close();
    if (!arguments.obj.empty())
        write_whole(arguments.obj, mesh_text(simulation, timeline::MeshFormat::obj, start.scene.name));
    if (!arguments.state.empty()) {
        const std::vector<std::byte> state = simulation.save_state();
        write_whole(arguments.state, {reinterpret_cast<const char*>(state.data()), state.size()});
    }
    if (recorder)
        recorder->finish();

    if (arguments.hash && !arguments.json) {
        std::cout << scene::hash_text(simulation.hash()) << "\n";
        return 0;
    }
    if (arguments.csv == "-")
        return 0; // the table would end up among the rows
    const Json json = results(start, simulation, frames, simulation.steps() - first_step, wall_s);
    if (arguments.json)
        std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << "\n"; // file names need not be UTF-8
    else
        print_fields(json);
    return 0;
}

} // namespace clothlab::cli
