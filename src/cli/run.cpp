// `clothlab run`: a scene without a picture, and its numbers.
#include <algorithm>
#include <cerrno>
#include <charconv>
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
#include "scene/io.h"
#include "sim/integrators/integrator.h"
#include "sim/intersections.h"
#include "sim/simulation.h"

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

/// Appends the fewest digits that read back as the same bits, in the precision of the run.
void append(std::string& text, double value, bool single) {
    char digits[32];
    const auto result = single ? std::to_chars(digits, digits + sizeof digits, static_cast<float>(value))
                               : std::to_chars(digits, digits + sizeof digits, value);
    text.append(digits, result.ptr);
}

/// Appends a point and the end of its line.
void append(std::string& text, const sim::Vec3& p, char separator, bool single) {
    append(text, p.x, single);
    text += separator;
    append(text, p.y, single);
    text += separator;
    append(text, p.z, single);
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

void write_obj(const std::string& file, const sim::Simulation& simulation, const std::string& title) {
    const sim::Cloth& cloth = simulation.description().cloth;
    const int columns = cloth.num_width_points, rows = cloth.num_height_points;
    const bool single = simulation.description().stepping.precision == sim::Precision::single_precision;
    std::string text = "# clothlab: " + title + "\no cloth\n";
    for (std::size_t i = 0; i < simulation.points(); ++i) {
        const sim::Vec3 p = simulation.position(i);
        text += "v ";
        append(text, p, ' ', single);
    }
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            text += "vt ";
            append(text, static_cast<double>(column) / (columns - 1), true);
            text += " ";
            append(text, static_cast<double>(row) / (rows - 1), true);
            text += "\n";
        }
    sim::for_each_triangle(columns, rows, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        text += "f";
        for (const std::uint32_t corner : {a, b, c}) {
            const std::string index = std::to_string(corner + 1);
            text += " " + index + "/" + index;
        }
        text += "\n";
    });
    Output out(file);
    out.write(text);
    out.close();
}

void write_state(const std::string& file, const sim::Simulation& simulation) {
    const std::vector<std::byte> bytes = simulation.save_state();
    Output out(file);
    out.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    out.close();
}

void resume(const std::string& file, sim::Simulation& simulation) {
    constexpr std::uintmax_t max_size = std::uintmax_t{1} << 30; // of the largest cloth in double precision: 192 MiB
    const std::string text = scene::read_text_file(file, max_size);
    try {
        simulation.load_state(std::as_bytes(std::span(text)));
    } catch (const std::invalid_argument& e) {
        throw scene::SceneError(file + ": " + e.what());
    }
}

std::uint64_t frames_to_run(const RunArguments& arguments, const sim::Description& description) {
    if (arguments.frames)
        return static_cast<std::uint64_t>(*arguments.frames);
    if (!arguments.seconds)
        return 90;
    // 0.1 s at 90 frames/s is 9 frames, not 10, whatever the product rounds to.
    const double frames = *arguments.seconds * description.stepping.frames_per_second;
    if (!(frames < 1e15))
        throw scene::SceneError("--seconds: too long a run");
    return static_cast<std::uint64_t>(std::ceil(frames * (1 - 1e-12)));
}

std::string hex(std::uint64_t value) {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(value));
    return digits;
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

Json results(const RunArguments& arguments, const scene::Scene& scene, const sim::Simulation& simulation,
             std::uint64_t frames, std::uint64_t steps, double wall_s) {
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
    return {{"scene", arguments.scene.scene},
            {"name", scene.name},
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
            {"hash", hex(simulation.hash())}};
}

void print_table(const Json& json, const std::string& prefix = "") {
    for (const auto& item : json.items()) {
        if (item.value().is_object()) {
            print_table(item.value(), prefix + item.key() + ".");
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
    const scene::Scene scene = arguments.scene.load();
    const std::uint64_t frames = frames_to_run(arguments, scene.simulation);
    const auto simulation = sim::Simulation::create(scene.simulation, execution(arguments));
    if (!arguments.resume.empty())
        resume(arguments.resume, *simulation);
    // Before the work, not after it: that an output cannot be written.
    for (const std::string& file : {arguments.obj, arguments.state})
        if (!file.empty())
            Output(file, std::ios::app).close();
    simulation->time_stages(true);
    simulation->watch(true);
    std::optional<Output> csv;
    if (!arguments.csv.empty()) {
        csv.emplace(arguments.csv);
        csv->write("frame,index,x,y,z\n");
        write_csv_frame(*csv, *simulation);
    }

    using Clock = std::chrono::steady_clock;
    double wall_s = 0;
    const std::uint64_t first_step = simulation->steps();
    for (std::uint64_t done = 1; done <= frames; ++done) {
        const auto start = Clock::now();
        simulation->step_frame();
        wall_s += std::chrono::duration<double>(Clock::now() - start).count();
        if (csv && done % static_cast<std::uint64_t>(arguments.every) == 0)
            write_csv_frame(*csv, *simulation);
    }
    if (csv)
        csv->close();
    if (!arguments.obj.empty())
        write_obj(arguments.obj, *simulation, scene.name);
    if (!arguments.state.empty())
        write_state(arguments.state, *simulation);

    if (arguments.hash && !arguments.json) {
        std::cout << hex(simulation->hash()) << "\n";
        return 0;
    }
    if (arguments.csv == "-")
        return 0; // the table would end up among the rows
    const Json json = results(arguments, scene, *simulation, frames, simulation->steps() - first_step, wall_s);
    if (arguments.json)
        std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << "\n"; // file names need not be UTF-8
    else
        print_table(json);
    return 0;
}

} // namespace clothlab::cli
