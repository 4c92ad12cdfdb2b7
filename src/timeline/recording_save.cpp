#include <algorithm>

#include "timeline/reader.h"
#include "timeline/recording.h"
#include "timeline/recording_writer.h"

namespace clothlab::timeline {
namespace {

/// Calls visit(step, linked, keyframe or null) for each state of a branch's own part that a recording has: those in the
/// cache, and at the ends of the frames and of the steps that are reached from them.
template <class Visit>
void for_each_state(const Branch& branch, Visit visit) {
    std::optional<std::uint64_t> reached; // from the keyframe before, the one of this step not counted
    for (std::size_t k = 0; k < branch.keyframes.size(); ++k) {
        const Keyframe& keyframe = branch.keyframes[k];
        const bool last = k + 1 == branch.keyframes.size();
        const std::uint64_t until = last ? keyframe.until : std::min(keyframe.until, branch.keyframes[k + 1].step);
        visit(keyframe.step, reached == keyframe.step, &keyframe);
        const bool handed_on = !last && branch.keyframes[k + 1].step == until;
        std::uint64_t at = keyframe.step;
        for (std::uint64_t frame = frame_time(branch, at).frame + 1; at < until; ++frame) {
            const std::uint64_t step = std::min(std::max(step_of_frame(branch, frame), at), until);
            if (step > at && !(step == until && handed_on))
                visit(step, true, static_cast<const Keyframe*>(nullptr));
            at = step;
        }
        reached = until;
    }
}

class Saver {
public:
    Saver(const Recording& recording, const std::filesystem::path& file, const sim::Execution& execution,
          const Progress& progress)
        : timeline_(recording.timeline), name_(file.string()), progress_(progress), writer_(file), reader_(execution) {
        for (const Branch& branch : timeline_.branches())
            for_each_state(branch, [&](std::uint64_t, bool, const Keyframe*) { ++states_; });
        if (states_ == 0)
            throw RecordingError(name_ + ": not written: there is nothing to save");
        writer_.write(recording.scene);
        writer_.write_contents(timeline_);
        writer_.write_playhead(recording.at);
        for (const Bookmark& bookmark : timeline_.bookmarks())
            writer_.write(bookmark);
    }

    void save() {
        for (const Branch& branch : timeline_.branches())
            save(branch);
        writer_.finish();
    }

private:
    void save(const Branch& branch) {
        writer_.begin(branch);
        auto change = branch.changes.begin();
        auto clock = branch.clocks.begin();
        auto mark = branch.marks.begin();
        auto sample = branch.samples.begin();
        bool trouble = branch.trouble.has_value();
        for_each_state(branch, [&](std::uint64_t step, bool linked, const Keyframe* keyframe) {
            for (; clock != branch.clocks.end() && clock->step <= step; ++clock)
                writer_.write(*clock);
            for (; change != branch.changes.end() && change->step <= step; ++change)
                writer_.write(*change);
            const auto first = sample;
            while (sample != branch.samples.end() && step_of_frame(branch, sample->frame) <= step)
                ++sample;
            write_state(branch, step, linked, keyframe, {first, sample});
            for (; mark != branch.marks.end() && mark->step <= step; ++mark)
                writer_.write(*mark);
            if (trouble && branch.trouble_step <= step) {
                writer_.write(*branch.trouble, branch.trouble_step);
                trouble = false;
            }
            ++written_;
            if (progress_ && !progress_(static_cast<double>(written_) / static_cast<double>(states_)))
                throw RecordingError(name_ + ": saving was cancelled");
        });
    }

    void write_state(const Branch& branch, std::uint64_t step, bool linked, const Keyframe* keyframe,
                     std::span<const Sample> samples) {
        RecordedState state{step, linked, nullptr, samples, {}};
        if (keyframe) {
            state.description = keyframe->description;
            if (keyframe->state)
                state.compressed = keyframe->state->compressed();
        } else {
            reader_.seek(timeline_, {branch.id, step});
            state.description = reader_.description();
            state.compressed = compress_state(reader_.simulation().save_state());
        }
        writer_.write(state);
    }

    const Timeline& timeline_;
    std::string name_;
    const Progress& progress_;
    RecordingWriter writer_;
    Reader reader_;
    std::size_t states_ = 0, written_ = 0;
};

} // namespace

void save_recording(const Recording& recording, const std::filesystem::path& file, const sim::Execution& execution,
                    const Progress& progress) {
    try {
        Saver(recording, file, execution, progress).save();
    } catch (const RecordingError&) {
        throw;
    } catch (const scene::FileError& e) {
        throw RecordingError(e.what());
    } catch (const std::exception& e) { // a state in a file that can no longer be read, or no memory
        throw RecordingError(file.string() + ": cannot be written: " + e.what());
    }
}

} // namespace clothlab::timeline
