// Pictures into an MP4 film, by the ffmpeg program.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>

#include <sys/types.h>

#include "app/gui/picture_sink.h"

namespace clothlab::app {

/// Whether PATH has a program ffmpeg.
bool has_ffmpeg();
/// What to say when it has none.
inline constexpr const char* ffmpeg_missing =
    "a film needs the program ffmpeg, which is not installed (package ffmpeg); PNG pictures do not";

class Film final : public PictureSink {
public:
    /// Starts ffmpeg. The file gets its name when it is finished; until then it is FILE.part, so that an older film of
    /// that name stays until then. Throws std::runtime_error when ffmpeg is not installed.
    Film(std::filesystem::path file, int width, int height, double frames_per_second);
    /// Removes an unfinished film.
    ~Film() override;
    Film(const Film&) = delete;
    Film& operator=(const Film&) = delete;

    /// Adds a picture of the film's size; opaque, whatever its alpha.
    void add(const render::Image& picture) override;
    void finish() override;
    void discard() override;

private:
    int wait_for_ffmpeg();
    [[noreturn]] void fail(const std::string& what);

    std::filesystem::path file_, partial_;
    int input_ = -1;                  ///< ffmpeg's standard input
    pid_t process_ = -1;              ///< of ffmpeg, until it has been waited for
    std::FILE* complaints_ = nullptr; ///< ffmpeg's standard error
};

} // namespace clothlab::app
