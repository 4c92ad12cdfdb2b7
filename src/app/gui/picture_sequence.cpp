#include "app/gui/picture_sequence.h"

#include <algorithm>
#include <regex>
#include <stdexcept>

namespace clothlab::app {
namespace fs = std::filesystem;
namespace {

const std::regex& number_place() {
    static const std::regex place("%(0?)([0-9]?)d");
    return place;
}

} // namespace

SequenceName::SequenceName(const fs::path& pattern) : folder_(pattern.parent_path()) {
    const std::string name = pattern.filename().string();
    std::smatch place;
    if (!std::regex_search(name, place, number_place()) || name.find('%') != name.rfind('%') ||
        folder_.string().find('%') != std::string::npos)
        throw std::runtime_error(pattern.string() +
                                 ": write one place for the number into the file's name, as in cloth-%04d.png");
    before_ = place.prefix();
    after_ = place.suffix();
    zeros_ = place[1].length() > 0;
    digits_ = place[2].length() > 0 ? std::stoi(place[2]) : 1;
}

bool SequenceName::is_pattern(const fs::path& file) {
    return file.string().find('%') != std::string::npos;
}

fs::path SequenceName::picture(int number) const {
    std::string digits = std::to_string(number);
    const auto missing = static_cast<std::size_t>(std::max(0, digits_ - static_cast<int>(digits.size())));
    digits.insert(0, missing, zeros_ ? '0' : ' ');
    return folder_ / (before_ + digits + after_);
}

int SequenceName::existing() const {
    int count = 0;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder_.empty() ? "." : folder_, error)) {
        const std::string name = entry.path().filename().string();
        if (name.size() <= before_.size() + after_.size() || name.rfind(before_, 0) != 0 ||
            name.compare(name.size() - after_.size(), after_.size(), after_) != 0)
            continue;
        const std::string digits = name.substr(before_.size(), name.size() - before_.size() - after_.size());
        count += std::all_of(digits.begin(), digits.end(), [](char c) { return c == ' ' || (c >= '0' && c <= '9'); });
    }
    return count;
}

void PictureSequence::add(const render::Image& picture) {
    render::write_png(picture, name_.picture(written_));
    ++written_;
}

void PictureSequence::discard() {
    std::error_code ignored;
    for (int i = 0; i < written_; ++i)
        fs::remove(name_.picture(i), ignored);
}

} // namespace clothlab::app
