#include "app/pictures.h"

#include <cstdio>
#include <iostream>
#include <regex>

#include "app/gui/film.h"
#include "app/gui/picture_sequence.h"
#include "app/scene_view.h"

namespace clothlab::app {
namespace fs = std::filesystem;
namespace {

constexpr const char* first_picture = "clothlab-0001.png";
constexpr const char* first_film = "clothlab-0001.mp4";
constexpr const char* first_sequence = "clothlab-0001-%04d.png";

bool taken(const std::string& name) {
    std::error_code error;
    if (!SequenceName::is_pattern(name))
        return fs::exists(name, error);
    try {
        return SequenceName(name).existing() > 0;
    } catch (const std::runtime_error&) {
        return false; // told when it is used
    }
}

/// The file that a name typed by the user means.
std::string with_ending(std::string name, const char* ending) {
    if (fs::path(name).extension() != ending)
        name += ending;
    return name;
}

std::string sequence_pattern(const std::string& name) {
    const std::string file = with_ending(name, ".png");
    return SequenceName::is_pattern(file) ? file : file.substr(0, file.size() - 4) + "-%04d.png";
}

/// What stands in the way of a name, for the panel.
std::string objection(const std::string& name) {
    if (!taken(name))
        return "";
    if (!SequenceName::is_pattern(name))
        return "This file exists and would be replaced.";
    const int count = SequenceName(name).existing();
    return std::to_string(count) + (count == 1 ? " picture" : " pictures") +
           " of this name exist; those with the same number would be replaced.";
}

std::string whole_path(const fs::path& file) {
    std::error_code error;
    const fs::path whole = fs::absolute(file, error);
    return error ? file.string() : whole.string();
}

} // namespace

std::string free_name(const std::string& wished) {
    if (!taken(wished))
        return wished;
    static const std::regex parts(R"((.*?)(?:-(\d{1,6}))?((?:-?%0?\d?d)?(?:\.[^./]*)?))");
    std::smatch match;
    std::regex_match(wished, match, parts);
    const int number = match[2].matched ? std::stoi(match[2]) : 0;
    for (int i = number + 1; i < number + 100000; ++i) {
        char digits[16];
        std::snprintf(digits, sizeof digits, "-%04d", i);
        const std::string name = match[1].str() + digits + match[3].str();
        if (!taken(name))
            return name;
    }
    return wished;
}

Pictures::Pictures(render::Renderer& renderer, SimulationThread& simulation, ui::Lab& lab)
    : renderer_(renderer), simulation_(simulation), lab_(lab) {}

Pictures::~Pictures() {
    if (!recorder_)
        return;
    end(true, "clothlab was closed");
    const ui::Message& last = lab_.messages.back(); // nobody sees the panels any more
    std::cerr << "clothlab: " << last.text << "\n";
}

PictureMaker Pictures::maker(bool transparent) const {
    const ui::Output& o = lab_.output;
    const bool own = !o.as_viewport || lab_.viewport_width < 1 || lab_.viewport_height < 1;
    return PictureMaker(renderer_, own ? o.width : lab_.viewport_width, own ? o.height : lab_.viewport_height,
                        samples_of(lab_.scene.look.multisampling, 4), transparent);
}

void Pictures::update() {
    lab_.output.hidden = window_file_.has_value();
    if (recorder_) {
        try {
            if (!recorder_->advance(lab_.scene, lab_.shaders))
                end(true, recorder_->why());
        } catch (const std::exception& e) {
            say(true, std::string("The recording ended: ") + e.what());
            recorder_.reset();
        }
    }
    describe();
}

void Pictures::describe() {
    ui::Output& o = lab_.output;
    o.recording.reset();
    if (recorder_) {
        o.recording = {recording_file_.string(), recorder_->pictures(), recorder_->plan().pictures,
                       recorder_->paused()};
        lab_.playing = !recorder_->paused(); // Space and the transport pause the recording
    }
    if (o.picture_file.empty()) {
        o.picture_file = free_name(first_picture);
        o.film_file = free_name(first_film);
        o.sequence_file = free_name(first_sequence);
    }
    if (!o.open)
        return;
    o.has_ffmpeg = has_ffmpeg();
    o.picture_objection = objection(with_ending(o.picture_file, ".png"));
    o.recording_objection = objection(o.film ? with_ending(o.film_file, ".mp4") : sequence_pattern(o.sequence_file));
}

bool Pictures::handle(const ui::Request& request) {
    if (const auto* picture = std::get_if<ui::TakePicture>(&request)) {
        take(*picture);
        return true;
    }
    if (const auto* recording = std::get_if<ui::Record>(&request)) {
        record(*recording);
        return true;
    }
    if (const auto* ended = std::get_if<ui::EndRecording>(&request)) {
        if (recorder_)
            end(ended->keep, "");
        return true;
    }
    if (!recorder_)
        return false;
    if (const auto* play = std::get_if<ui::Play>(&request)) {
        recorder_->pause(!play->on);
        return true;
    }
    if (std::holds_alternative<ui::Restart>(request) || std::holds_alternative<ui::OpenScene>(request))
        end(true, "the run was started anew");
    // Steps by hand would be missing from the recording.
    return std::holds_alternative<ui::StepFrame>(request) || std::holds_alternative<ui::StepSubstep>(request);
}

void Pictures::take(const ui::TakePicture& wanted) {
    ui::Output& o = lab_.output;
    const std::string file = wanted.file.empty() ? free_name(with_ending(o.picture_file, ".png"))
                                                 : with_ending(wanted.file.string(), ".png");
    if (!wanted.replace && taken(file))
        return say(true, file + ": this file exists; choose another name, or Replace");
    if (o.with_panels) {
        window_file_ = file;
        return;
    }
    try {
        keep(maker(o.transparent)
                 .draw(lab_.scene, lab_.shaders, lab_.snapshot.get(), lab_.timeline.ghost_snapshot.get(),
                       trace_choice(lab_)),
             file);
    } catch (const std::exception& e) {
        say(true, e.what());
    }
}

void Pictures::take_window(const render::Image& window) {
    const fs::path file = *window_file_;
    window_file_.reset();
    lab_.output.hidden = false;
    try {
        keep(window, file);
    } catch (const std::exception& e) {
        say(true, e.what());
    }
}

void Pictures::keep(const render::Image& picture, const fs::path& file) {
    render::write_png(picture, file);
    say(false, "The picture was saved as " + whole_path(file));
    lab_.output.picture_file = free_name(file.string());
}

void Pictures::record(const ui::Record& wanted) {
    if (recorder_)
        return;
    const ui::Output& o = lab_.output;
    const std::string file = o.film ? with_ending(o.film_file, ".mp4") : sequence_pattern(o.sequence_file);
    if (!wanted.replace && taken(file))
        return say(true, file + ": this exists already; choose another name, or Record and replace");
    const ui::Pace pace = ui::pace(o, lab_.scene.simulation.stepping.frames_per_second);
    try {
        PictureMaker pictures = maker(o.transparent && !o.film);
        std::unique_ptr<PictureSink> sink;
        if (o.film)
            sink = std::make_unique<Film>(file, pictures.width(), pictures.height(), pace.rate);
        else
            sink = std::make_unique<PictureSequence>(SequenceName(file));
        if (o.from_start) {
            simulation_.play(false); // or the new run could take a frame before the recorder has its first
            simulation_.restart(lab_.scene.simulation);
        }
        recorder_ = std::make_unique<Recorder>(RecordingPlan{pace.every, pace.pictures}, simulation_,
                                               std::move(pictures), std::move(sink));
        recording_file_ = file;
        describe();
    } catch (const std::exception& e) {
        say(true, e.what());
    }
}

void Pictures::end(bool keep, const std::string& why) {
    const std::unique_ptr<Recorder> recorder = std::move(recorder_);
    const std::string count =
        std::to_string(recorder->pictures()) + (recorder->pictures() == 1 ? " picture" : " pictures");
    try {
        if (keep && recorder->pictures() > 0) {
            recorder->finish();
            say(false, "Recorded " + count + (why.empty() ? "" : ", then it ended: " + why) + ". " +
                           whole_path(recording_file_));
        } else {
            recorder->discard();
            say(false, why.empty() ? "The recording was cancelled; nothing of it is left."
                                   : "The recording ended before its first picture: " + why + ".");
        }
    } catch (const std::exception& e) {
        say(true, std::string("The recording ended: ") + e.what());
    }
    lab_.output.film_file = free_name(lab_.output.film_file);
    lab_.output.sequence_file = free_name(lab_.output.sequence_file);
    describe();
}

} // namespace clothlab::app
