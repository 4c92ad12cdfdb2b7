#include "app/core/recording_job.h"

#include <cstdio>
#include <utility>

namespace clothlab::app {
namespace {

std::string size_of(const std::filesystem::path& file) {
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(file, error);
    char text[32];
    std::snprintf(text, sizeof text, "%.1f MB", static_cast<double>(error ? 0 : bytes) / 1e6);
    return text;
}

} // namespace

RecordingJob::~RecordingJob() {
    cancel();
    wait();
}

void RecordingJob::wait() {
    if (thread_.joinable())
        thread_.join();
}

bool RecordingJob::begin(std::string what, Work work) {
    {
        const std::lock_guard lock(mutex_);
        if (busy_)
            return false;
        busy_ = true;
        what_ = std::move(what);
        result_.reset();
    }
    wait(); // for the last one's thread, which has nothing left to do
    share_ = 0;
    cancelled_ = false;
    thread_ = std::thread([this, work = std::move(work)] {
        Result result;
        try {
            result = work([this](double share) {
                share_ = share;
                return !cancelled_;
            });
            result.succeeded = true;
        } catch (const std::exception& e) {
            result.text = e.what();
            result.cancelled = cancelled_;
        }
        const std::lock_guard lock(mutex_);
        result_ = std::move(result);
        busy_ = false;
    });
    return true;
}

bool RecordingJob::save(timeline::Recording recording, std::filesystem::path file) {
    const std::string name = file.filename().string();
    return begin("Saving " + name,
                 [recording = std::move(recording), file = std::move(file), name](const timeline::Progress& progress) {
                     timeline::save_recording(recording, file, {}, progress);
                     return Result{.text = "Saved " + name + ", " + size_of(file) + ".", .loaded = {}};
                 });
}

bool RecordingJob::load(std::filesystem::path file) {
    const std::string name = file.filename().string();
    return begin("Loading " + name, [file = std::move(file), name](const timeline::Progress& progress) {
        Result result;
        result.loaded = timeline::load_recording(file, progress);
        result.text =
            result.loaded->damage.empty() ? "Loaded " + name + ", " + size_of(file) + "." : result.loaded->damage;
        return result;
    });
}

bool RecordingJob::write_meshes(timeline::Timeline timeline, timeline::MeshSequence sequence) {
    const std::string name = sequence.folder.filename().string();
    return begin("Exporting to " + name,
                 [timeline = std::move(timeline), sequence = std::move(sequence)](const timeline::Progress& progress) {
                     const timeline::MeshesWritten written = timeline::write_meshes(timeline, sequence, {}, progress);
                     std::string text = "Wrote " + std::to_string(written.files) +
                                        (written.files == 1 ? " mesh" : " meshes") + " to " + sequence.folder.string();
                     if (written.missing > 0)
                         text += "; " + std::to_string(written.missing) + " frames are no longer in the cache";
                     return Result{.text = text + ".", .loaded = {}};
                 });
}

std::optional<RecordingJob::Status> RecordingJob::status() const {
    const std::lock_guard lock(mutex_);
    if (!busy_)
        return std::nullopt;
    return Status{what_, share_};
}

std::optional<RecordingJob::Result> RecordingJob::take_result() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, std::nullopt);
}

} // namespace clothlab::app
