#include "app/gui/film.h"

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace clothlab::app {
namespace {

/// A word for the shell that nothing in it has a meaning for.
std::string quoted(const std::string& word) {
    std::string text = "'";
    for (const char c : word)
        text += c == '\'' ? "'\\''" : std::string(1, c);
    return text + "'";
}

} // namespace

Film::Film(const std::filesystem::path& file, int width, int height, double frames_per_second) : file_(file) {
    if (std::system("command -v ffmpeg >/dev/null 2>&1") != 0)
        throw std::runtime_error(file.string() +
                                 ": a film needs the program ffmpeg, which is not installed (package ffmpeg); "
                                 "a single picture, -o FILE.png, does not");
    std::signal(SIGPIPE, SIG_IGN); // an ffmpeg that ends early is an error to report, not the end of this program
    // H.264 with half the colour resolution plays everywhere; it needs even sizes.
    const std::string command =
        "ffmpeg -loglevel error -y -f rawvideo -pixel_format rgba -video_size " + std::to_string(width) + "x" +
        std::to_string(height) + " -framerate " + std::to_string(frames_per_second) +
        " -i - -vf 'pad=ceil(iw/2)*2:ceil(ih/2)*2' -pix_fmt yuv420p -movflags +faststart -f mp4 " +
        quoted("file:" + file.string());
    pipe_ = popen(command.c_str(), "w");
    if (!pipe_)
        throw std::runtime_error(file.string() + ": ffmpeg cannot be started");
}

Film::~Film() {
    if (!pipe_)
        return;
    pclose(pipe_);
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
}

void Film::add(const render::Image& picture) {
    if (std::fwrite(picture.rgba.data(), 1, picture.rgba.size(), pipe_) != picture.rgba.size())
        throw std::runtime_error(file_.string() + ": ffmpeg stopped before the film was complete");
}

void Film::finish() {
    const int status = pclose(pipe_);
    pipe_ = nullptr;
    if (status != 0)
        throw std::runtime_error(file_.string() + ": ffmpeg could not write the film");
}

} // namespace clothlab::app
