#include "app/core/shader_watch.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>

namespace clothlab::app {
namespace fs = std::filesystem;
namespace {

/// Files that editors make beside the one that is edited.
bool is_scratch(const fs::path& file) {
    const std::string name = file.filename().string();
    return name.starts_with('.') || name.ends_with('~');
}

std::size_t hash_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return std::hash<std::string>()({std::istreambuf_iterator<char>(in), {}});
}

} // namespace

ShaderWatch::ShaderWatch(std::vector<fs::path> folders) : folders_(std::move(folders)), files_(files_now()) {
    looked_ = std::chrono::steady_clock::now();
}

ShaderWatch::Files ShaderWatch::files_now() const {
    // The clock of a file system may be as coarse as two seconds (FAT): a file that was written since then is compared
    // by its text, as one more change may hide behind the same time.
    const auto recently = fs::file_time_type::clock::now() - std::chrono::seconds(3);
    Files files;
    for (const fs::path& folder : folders_) {
        std::error_code error;
        fs::recursive_directory_iterator entries(folder, fs::directory_options::skip_permission_denied, error), end;
        for (; !error && entries != end; entries.increment(error)) {
            std::error_code gone; // between being listed and being looked at
            const fs::path& file = entries->path();
            if (is_scratch(file) || !fs::is_regular_file(file, gone))
                continue;
            State state{fs::last_write_time(file, gone), fs::file_size(file, gone)};
            if (gone)
                continue;
            const auto before = files_.find(file);
            const bool same =
                before != files_.end() && before->second.written == state.written && before->second.size == state.size;
            state.hash = same && state.written < recently ? before->second.hash : hash_of(file);
            files.emplace(file, state);
        }
    }
    return files;
}

bool ShaderWatch::look() {
    looked_ = std::chrono::steady_clock::now();
    Files now = files_now();
    const bool same =
        std::equal(now.begin(), now.end(), files_.begin(), files_.end(),
                   [](const auto& a, const auto& b) { return a.first == b.first && a.second.hash == b.second.hash; });
    files_ = std::move(now);
    return !same;
}

bool ShaderWatch::look_after(double seconds) {
    const std::chrono::duration<double> since = std::chrono::steady_clock::now() - looked_;
    return since.count() >= seconds && look();
}

} // namespace clothlab::app
