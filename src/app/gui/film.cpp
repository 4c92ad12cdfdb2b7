#include "app/gui/film.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ; // NOLINT: POSIX's name

namespace clothlab::app {
namespace fs = std::filesystem;
namespace {

/// The program's file, or nothing when no folder of PATH has it.
std::string find_program(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const fs::path file = fs::path(folder.empty() ? "." : folder) / name;
        std::error_code error;
        if (fs::is_regular_file(file, error) && ::access(file.c_str(), X_OK) == 0)
            return file.string();
    }
    return "";
}

/// Both ends closed in programs that are started from here.
std::array<int, 2> make_pipe() {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0)
        throw std::runtime_error(std::string("ffmpeg cannot be started: ") + std::strerror(errno));
    for (const int end : ends)
        ::fcntl(end, F_SETFD, FD_CLOEXEC);
    return ends;
}

pid_t start(const std::string& program, std::vector<std::string> words, int input, int errors) {
    std::vector<char*> argv;
    for (std::string& word : words)
        argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
    pid_t process = -1;
    const int error = posix_spawn(&process, program.c_str(), &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0)
        throw std::runtime_error(program + " cannot be started: " + std::strerror(error));
    return process;
}

} // namespace

bool has_ffmpeg() {
    return !find_program("ffmpeg").empty();
}

Film::Film(fs::path file, int width, int height, double frames_per_second) : file_(std::move(file)), partial_(file_) {
    partial_ += ".part";
    const std::string program = find_program("ffmpeg");
    if (program.empty())
        throw std::runtime_error(file_.string() + ": " + ffmpeg_missing);
    std::signal(SIGPIPE, SIG_IGN); // an ffmpeg that ends early is an error to report, not the end of this program
    complaints_ = std::tmpfile();
    if (complaints_ == nullptr)
        throw std::runtime_error(std::string("no temporary file: ") + std::strerror(errno));
    const std::array<int, 2> pipe = make_pipe();
    // H.264 with half the colour resolution plays everywhere; it needs even sizes, so that odd ones get a black line.
    // Its colours are said to be, and are, those of high-definition television, as players expect them.
    try {
        process_ = start(program,
                         {"ffmpeg",
                          "-loglevel",
                          "error",
                          "-y",
                          "-f",
                          "rawvideo",
                          "-pixel_format",
                          "rgba",
                          "-video_size",
                          std::to_string(width) + "x" + std::to_string(height),
                          "-framerate",
                          std::to_string(frames_per_second),
                          "-i",
                          "-",
                          "-vf",
                          "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709",
                          "-pix_fmt",
                          "yuv420p",
                          "-colorspace",
                          "bt709",
                          "-color_primaries",
                          "bt709",
                          "-color_trc",
                          "bt709",
                          "-movflags",
                          "+faststart",
                          "-f",
                          "mp4",
                          "file:" + partial_.string()},
                         pipe[0], ::fileno(complaints_));
    } catch (...) {
        ::close(pipe[0]);
        ::close(pipe[1]);
        std::fclose(complaints_);
        throw;
    }
    ::close(pipe[0]);
    input_ = pipe[1];
}

Film::~Film() {
    Film::discard();
    std::fclose(complaints_);
}

void Film::add(const render::Image& picture) {
    const std::uint8_t* next = picture.rgba.data();
    for (std::size_t left = picture.rgba.size(); left > 0;) {
        const ssize_t written = ::write(input_, next, left);
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
            fail("ffmpeg stopped before the film was complete");
        next += written;
        left -= static_cast<std::size_t>(written);
    }
}

void Film::finish() {
    if (wait_for_ffmpeg() != 0)
        fail("ffmpeg could not write the film");
    std::error_code error;
    fs::rename(partial_, file_, error);
    if (error)
        fail("cannot be written: " + error.message());
}

void Film::discard() {
    if (process_ < 0)
        return;
    wait_for_ffmpeg();
    std::error_code ignored;
    fs::remove(partial_, ignored);
}

/// The exit status; -1 when a signal ended it.
int Film::wait_for_ffmpeg() {
    if (input_ >= 0)
        ::close(input_);
    input_ = -1;
    int status = 0;
    while (process_ >= 0 && ::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// With the last thing that ffmpeg said, which is why.
void Film::fail(const std::string& what) {
    wait_for_ffmpeg();
    std::error_code ignored;
    fs::remove(partial_, ignored);
    std::string why;
    std::rewind(complaints_);
    std::array<char, 512> line{};
    while (std::fgets(line.data(), static_cast<int>(line.size()), complaints_) != nullptr)
        if (line[0] != '\n')
            why = line.data();
    while (!why.empty() && why.back() == '\n')
        why.pop_back();
    throw std::runtime_error(file_.string() + ": " + what + (why.empty() ? "" : ": " + why));
}

} // namespace clothlab::app
