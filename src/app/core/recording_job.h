// Saving, loading and exporting in a thread of its own, so that the window never waits. One at a time.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "timeline/mesh_sequence.h"
#include "timeline/recording.h"

namespace clothlab::app {

class RecordingJob {
public:
    RecordingJob() = default;
    /// Cancels what is under way, and waits for that: a state at most.
    ~RecordingJob();
    RecordingJob(const RecordingJob&) = delete;
    RecordingJob& operator=(const RecordingJob&) = delete;

    /// Each begins, or returns false, and does nothing, while another is under way.
    bool save(timeline::Recording recording, std::filesystem::path file);
    bool load(std::filesystem::path file);
    bool write_meshes(timeline::Timeline timeline, timeline::MeshSequence sequence);

    struct Status {
        std::string what; ///< "Saving fold.clothrec"
        double share = 0; ///< done, 0 to 1
    };
    /// What is under way; none while there is nothing.
    std::optional<Status> status() const;
    /// Ends it soon, as a failure.
    void cancel() { cancelled_ = true; }

    struct Result {
        bool succeeded = false;
        bool cancelled = false;
        std::string text;                          ///< a sentence: what was done, or why it was not
        std::optional<timeline::Recording> loaded; ///< by load
    };
    /// What the last one came to, once: none before it is over.
    std::optional<Result> take_result();
    /// Waits until nothing is under way: for tests and the end of programs, not for the window.
    void wait();

private:
    using Work = std::function<Result(const timeline::Progress&)>;
    bool begin(std::string what, Work work);

    std::thread thread_;
    mutable std::mutex mutex_; ///< of all that follows, but for the atomic ones
    std::string what_;
    bool busy_ = false;
    std::optional<Result> result_;
    std::atomic<double> share_ = 0;
    std::atomic<bool> cancelled_ = false;
};

} // namespace clothlab::app
