// `clothlab experiment sweep` and `clothlab experiment merge`.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>

#include "cli/experiment/experiment.h"
#include "cli/experiment/sweep_journal.h"
#include "cli/experiment/sweep_pictures.h"
#include "cli/experiment/sweep_workers.h"
#include "cli/finite.h"
#include "experiments/sweep/file.h"
#include "scene/io.h"
#include "scene/whole_file.h"

namespace clothlab::cli {
namespace {

struct SweepArguments {
    SceneArguments scene;
    std::vector<std::string> vary; ///< of parse_axis
    std::uint64_t frames = 90;
    std::optional<double> seconds;
    std::string plot = "max_strain";
    std::string shard; ///< I/N
    int jobs = 0;
    bool times = false, fresh = false;
    std::string pictures, picture_size = "320x240";
    FindingsOutput output;
};

/// Cells whose number leaves `index` when divided by `count`.
struct Shard {
    std::size_t index = 0, count = 1;
    bool has(std::size_t cell) const { return cell % count == index; }
};

Shard read_shard(const std::string& text) {
    if (text.empty())
        return {};
    std::size_t number = 0, count = 0;
    char end = 0;
    if (text.find('-') != std::string::npos || std::sscanf(text.c_str(), "%zu/%zu%c", &number, &count, &end) != 2 ||
        number < 1 || number > count)
        throw scene::SceneError("--shard " + text + ": write I/N, the I-th of N parts, such as 1/4");
    return {number - 1, count};
}

experiments::SweepConfig config_of(const SweepArguments& arguments) {
    experiments::SweepConfig config;
    config.name = arguments.scene.scene;
    config.scene = arguments.scene.load();
    for (const std::string& text : arguments.vary) {
        config.axes.push_back(experiments::parse_axis(text));
        for (const std::string& setting : arguments.scene.settings)
            if (setting.starts_with(config.axes.back().key + "="))
                throw scene::SceneError("--set " + setting + ": --vary varies it");
    }
    config.length = {arguments.frames, arguments.seconds};
    config.times = arguments.times;
    config.plot = arguments.plot;
    return config;
}

std::atomic<bool> asked_to_stop = false;

/// A second one ends the program at once: what is finished is in the file all the same.
void on_signal(int signal) {
    asked_to_stop = true;
    std::signal(signal, SIG_DFL);
}

/// While the workers are at work.
class Signals {
public:
    Signals() {
        static_assert(std::atomic<bool>::is_always_lock_free); // a signal may write it
        std::signal(SIGINT, on_signal);
        std::signal(SIGTERM, on_signal);
        std::signal(SIGPIPE, SIG_IGN); // a worker that has ended is found out by its output
    }
    ~Signals() {
        for (const int signal : {SIGINT, SIGTERM, SIGPIPE})
            std::signal(signal, SIG_DFL);
    }
    Signals(const Signals&) = delete;
    Signals& operator=(const Signals&) = delete;
};

bool is_journal(const std::string& file) {
    std::error_code error;
    return !file.empty() && file != "-" &&
           (!std::filesystem::exists(file, error) || std::filesystem::is_regular_file(file, error));
}

/// One call of the command.
class Command {
public:
    Command(const SweepArguments& arguments, const GuiCommands& gui)
        : arguments_(arguments), gui_(gui), shard_(read_shard(arguments.shard)), sweep_(config_of(arguments)) {
        check_pictures();
        for (std::size_t cell = 0; cell < sweep_.cells(); ++cell)
            if (shard_.has(cell))
                cells_.push_back(cell);
        if (arguments.fresh && !is_journal(arguments.output.csv))
            throw scene::SceneError("--fresh: there is no --csv file to begin anew");
    }

    int run() {
        FindingsOutput output = arguments_.output;
        if (is_journal(output.csv))
            output.csv.clear(); // written here, cell by cell
        const int status = conduct([this](const experiments::Progress& progress) { return run(progress); },
                                   sweep_.config().scene, output, gui_);
        if (!failed_.empty())
            return complain();
        if (!arguments_.pictures.empty())
            draw_pictures(arguments_.pictures);
        return status;
    }

private:
    const experiments::SweepRows& rows() const { return journal_ ? journal_->rows() : rows_; }

    std::vector<experiments::ReportPicture> pictures_for_report(const std::filesystem::path& folder) const {
        int width = 0, height = 0;
        read_size(arguments_.picture_size, width, height);
        if (!gui_.draw_grid || rows().size() < sweep_.cells() || !objection_to_grid(sweep_, width, height).empty())
            return {};
        draw_pictures((folder / "pictures.png").string());
        return {{"pictures.png", "The last frame of every cell"}};
    }

    void draw_pictures(const std::string& file) const {
        SceneGrid grid = sweep_pictures(sweep_, rows());
        grid.file = file;
        grid.jobs = arguments_.jobs;
        read_size(arguments_.picture_size, grid.width, grid.height);
        gui_.draw_grid(grid);
    }

    void check_pictures() const {
        int width = 0, height = 0;
        read_size(arguments_.picture_size, width, height);
        if (arguments_.pictures.empty())
            return;
        if (!gui_.draw_grid)
            throw scene::SceneError("--pictures: this clothlab was built without its GUI and cannot draw");
        if (!arguments_.shard.empty())
            throw scene::SceneError("--pictures: a shard has only some of the pictures; leave out --shard");
        if (const std::string why = objection_to_grid(sweep_, width, height); !why.empty())
            throw scene::SceneError("--pictures: " + why);
        std::optional<scene::Look> checked; // most sweeps have one
        for (std::size_t cell = 0; cell < sweep_.cells(); ++cell)
            if (const scene::Scene scene = sweep_.scene(cell); scene.look != checked) {
                gui_.check_look(scene, sweep_.config().name);
                checked = scene.look;
            }
        scene::WholeFile{arguments_.pictures};
    }

    void open_journal() {
        const std::string& file = arguments_.output.csv;
        journal_.emplace(sweep_, file, arguments_.fresh);
        for (const auto& [cell, row] : journal_->rows())
            if (!shard_.has(cell))
                throw scene::SceneError(file + ": has cell " + std::to_string(cell) + ", which is not of shard " +
                                        arguments_.shard + "; give each shard a file of its own");
        if (!journal_->rows().empty())
            std::cerr << "clothlab: " << journal_->rows().size() << " of " << cells_.size()
                      << " cells were finished before\n";
    }

    experiments::Findings run(const experiments::Progress& progress) {
        if (is_journal(arguments_.output.csv))
            open_journal();
        std::vector<std::size_t> left;
        std::copy_if(cells_.begin(), cells_.end(), std::back_inserter(left),
                     [this](std::size_t cell) { return !rows().contains(cell); });
        const experiments::Progress stoppable{[&progress](double share, const std::string& what) {
            progress.tell(share, what);
            return !asked_to_stop;
        }};
        bool stopped = false;
        try {
            const Signals signals;
            failed_ = run_in_workers(
                sweep_, left, arguments_.jobs,
                [this](std::size_t cell, std::vector<experiments::Value> row) {
                    if (journal_)
                        journal_->add(cell, std::move(row));
                    else
                        rows_[cell] = std::move(row);
                },
                stoppable);
        } catch (const experiments::Cancelled&) {
            stopped = true;
        }
        if (journal_)
            journal_->finish();
        if (stopped)
            throw std::runtime_error("stopped: " + how_far());
        experiments::Findings findings = sweep_.findings(rows());
        if (!arguments_.shard.empty())
            findings.title += ", shard " + arguments_.shard;
        return findings;
    }

    std::string how_far() const {
        return std::to_string(rows().size()) + " of " + std::to_string(cells_.size()) + " cells are finished" +
               (journal_ ? " and kept in " + arguments_.output.csv + "; the same command goes on with the rest"
                         : "; without --csv FILE nothing of them is kept");
    }

    int complain() const {
        constexpr std::size_t most = 20;
        std::size_t said = 0;
        for (const auto& [cell, why] : failed_) {
            if (said++ == most) {
                std::cerr << "clothlab: and " << failed_.size() - most << " more cells\n";
                break;
            }
            std::cerr << "clothlab: " << cell_name(sweep_, cell) << " could not be run: " << why << "\n";
        }
        std::cerr << "clothlab: " << how_far() << "\n";
        return 1;
    }

    const SweepArguments& arguments_;
    const GuiCommands& gui_;
    Shard shard_;
    experiments::Sweep sweep_;
    std::vector<std::size_t> cells_; ///< of the shard
    std::optional<SweepJournal> journal_;
    experiments::SweepRows rows_; ///< without a journal
    std::map<std::size_t, std::string> failed_;
};

struct MergeArguments {
    std::vector<std::string> files;
    std::string output;
};

int merge(const MergeArguments& arguments) {
    constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 30;
    std::vector<experiments::SweepShard> shards;
    for (const std::string& file : arguments.files)
        shards.push_back({file, scene::read_text_file(file, most_bytes)});
    const std::string text = merge_shards(shards);
    if (arguments.output == "-") {
        std::cout << text;
        return 0;
    }
    scene::write_text_file(text, arguments.output);
    std::cout << arguments.output << "\n";
    return 0;
}

void add_merge(CLI::App& experiment, int& status) {
    auto* merge =
        experiment.add_subcommand("merge", "Join the CSV files of a sweep's shards into that of the whole sweep");
    auto arguments = std::make_shared<MergeArguments>();
    merge->add_option("files", arguments->files, "CSV files of all shards of one sweep")->required();
    merge->add_option("-o,--output", arguments->output, "The file to write; - is standard output")->required();
    merge->final_callback([arguments, &status] { status = cli::merge(*arguments); });
}

} // namespace

void add_sweep(CLI::App& experiment, const GuiCommands& gui, int& status) {
    auto* sweep = experiment.add_subcommand("sweep", "Run a scene for many values of its parameters");
    auto arguments = std::make_shared<SweepArguments>();
    SweepArguments& a = *arguments;
    add_scene(*sweep, a.scene, true);
    sweep
        ->add_option(
            "--vary", a.vary,
            "KEY=FIRST:LAST:COUNT, KEY=FIRST:LAST:COUNTlog (by factors) or KEY=VALUE,VALUE,...: a parameter and "
            "its values; repeat for more, and every combination is run")
        ->required()
        ->take_all()
        ->allow_extra_args(false);
    auto* frames =
        sweep->add_option("--frames", a.frames, "Frames of each run (default: 90)")->check(CLI::NonNegativeNumber);
    sweep->add_option("--seconds", a.seconds, "Simulated seconds of each run instead, rounded up to a whole frame")
        ->check(finite_non_negative)
        ->excludes(frames);
    add_output(*sweep, a.output);
    sweep->add_flag("--fresh", a.fresh,
                    "Begin anew, whatever is in the --csv file; without it the sweep goes on from there");
    sweep->add_option("--plot", a.plot, "The column that is charted (default: max_strain)");
    sweep->add_option("--pictures", a.pictures,
                      "Draw the last frame of every cell into this PNG file, as a labelled grid");
    sweep->add_option("--picture-size", a.picture_size, "WIDTHxHEIGHT of each of those pictures (default: 320x240)");
    sweep->add_option("--shard", a.shard, "I/N: only the I-th of N equal parts; see merge");
    sweep->add_option("--jobs", a.jobs, "Processes at a time (default: one for each core)")->check(CLI::Range(1, 1024));
    sweep->add_flag("--times", a.times, "Also wall times, which are not the same again");
    sweep->final_callback([arguments, &gui, &status] { status = Command(*arguments, gui).run(); });
    add_merge(experiment, status);
    auto* worker = experiment.add_subcommand("sweep-worker", "Run cells for a sweep")->group("");
    worker->final_callback([&status] { status = sweep_worker(); });
}

} // namespace clothlab::cli
