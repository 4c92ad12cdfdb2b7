// A recording as PNG pictures with numbers.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/gui/picture_sink.h"

namespace clothlab::app {

/// File names with a place for a number, as in cloth-%04d.png: pictures have the numbers 0, 1, 2 ...
class SequenceName {
public:
    /// Throws std::runtime_error when the file's name has not exactly one place for a number (%d, %4d, %04d), or when
    /// its folders have one.
    explicit SequenceName(const std::filesystem::path& pattern);
    /// Whether a file's name is meant as a pattern.
    static bool is_pattern(const std::filesystem::path& file);

    std::filesystem::path picture(int number) const;
    /// Files that are there already under names of this pattern.
    int existing() const;

private:
    std::filesystem::path folder_;
    std::string before_, after_;
    int digits_ = 0; ///< at least
    bool zeros_ = false;
};

class PictureSequence final : public PictureSink {
public:
    explicit PictureSequence(SequenceName name) : name_(std::move(name)) {}
    void add(const render::Image& picture) override;
    void finish() override {}
    void discard() override;

private:
    SequenceName name_;
    int written_ = 0;
};

} // namespace clothlab::app
