// Whether shader files have changed on disk: by looking at them, which works on every system, with every editor and on
// network folders; a look at a few dozen files takes less than a tenth of a millisecond.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

namespace clothlab::app {

class ShaderWatch {
public:
    /// Takes the files below the folders as they are now. Folders need not be there yet.
    explicit ShaderWatch(std::vector<std::filesystem::path> folders);

    /// Whether files have been written, replaced, added or removed since the last look.
    bool look();
    /// The same, when the last look is so many seconds ago; else false.
    bool look_after(double seconds);

private:
    struct State {
        std::filesystem::file_time_type written;
        std::uintmax_t size = 0;
        std::size_t hash = 0; ///< of the text
    };
    using Files = std::map<std::filesystem::path, State>;
    Files files_now() const;

    std::vector<std::filesystem::path> folders_;
    Files files_;
    std::chrono::steady_clock::time_point looked_;
};

} // namespace clothlab::app
