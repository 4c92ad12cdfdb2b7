// Pictures into an MP4 film, by the ffmpeg program.
#pragma once

#include <cstdio>
#include <filesystem>

#include "render/image.h"

namespace clothlab::app {

class Film {
public:
    /// Starts ffmpeg. Throws std::runtime_error when it is not installed.
    Film(const std::filesystem::path& file, int width, int height, double frames_per_second);
    /// Ends ffmpeg; an unfinished film is removed.
    ~Film();
    Film(const Film&) = delete;
    Film& operator=(const Film&) = delete;

    /// Adds a picture of the film's size. Throws std::runtime_error when ffmpeg has gone.
    void add(const render::Image& picture);
    /// Waits until the file is complete. Throws std::runtime_error when ffmpeg could not write it.
    void finish();

private:
    std::filesystem::path file_;
    std::FILE* pipe_ = nullptr;
};

} // namespace clothlab::app
