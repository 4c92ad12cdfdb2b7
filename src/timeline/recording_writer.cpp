#include "timeline/recording_writer.h"

#include "scene/error.h"
#include "scene/io.h"
#include "timeline/recording.h"

namespace clothlab::timeline {

RecordingWriter::RecordingWriter(const std::filesystem::path& file)
    : name_(file.string()), chunks_(file, recording_magic, recording_version) {}

void RecordingWriter::write(const scene::Scene& scene) {
    chunks_.write(chunk::scene, Packer().append(scene::write_scene(scene)));
}

void RecordingWriter::write_contents(const Timeline& timeline) {
    Packer payload;
    payload.put(static_cast<std::uint32_t>(timeline.branches().size()));
    for (const Branch& branch : timeline.branches())
        payload.put(branch.id).put(branch.name).put(branch.end).put(frame_time(branch, branch.end).frame);
    chunks_.write(chunk::contents, payload);
}

void RecordingWriter::write_playhead(const Moment& moment) {
    chunks_.write(chunk::playhead, Packer().put(moment.branch).put(moment.step));
}

void RecordingWriter::write(const Bookmark& bookmark) {
    Packer payload;
    payload.put(bookmark.moment.branch).put(bookmark.moment.step).put(bookmark.name);
    payload.put(bookmark.camera ? scene::write_camera(*bookmark.camera) : std::string());
    chunks_.write(chunk::bookmark, payload);
}

std::uint32_t RecordingWriter::number_of(const DescriptionPtr& description) {
    const auto [place, is_new] =
        descriptions_.try_emplace(description, static_cast<std::uint32_t>(descriptions_.size()));
    if (is_new) {
        scene::Scene scene;
        scene.simulation = *description;
        const std::string text = scene::write_scene(scene);
        bool same = false;
        try {
            same = scene::read_scene(text, name_).simulation == *description;
        } catch (const scene::SceneError&) {
        }
        if (!same)
            throw RecordingError(name_ + ": cannot be written: a run has parameters that no scene file can have");
        chunks_.write(chunk::description, Packer().append(text));
    }
    return place->second;
}

void RecordingWriter::begin(const Branch& branch) {
    const std::uint32_t start = number_of(branch.start);
    Packer payload;
    payload.put(branch.id).put(branch.name).put(branch.parent).put(branch.fork_step);
    payload.put(static_cast<std::uint8_t>(branch.stem)).put(start);
    chunks_.write(chunk::branch, payload);
}

void RecordingWriter::write(const Change& change) {
    const std::uint32_t description = number_of(change.description);
    chunks_.write(chunk::change, Packer().put(change.step).put(description));
}

void RecordingWriter::write(const FrameClock& clock) {
    Packer payload;
    payload.put(clock.step).put(clock.frame).put(clock.substep).put(clock.substeps).put(clock.time).put(clock.dt);
    chunks_.write(chunk::clock, payload);
}

void RecordingWriter::write(const RecordedState& state) {
    const std::uint32_t description = number_of(state.description);
    Packer payload;
    payload.put(state.step).put(static_cast<std::uint8_t>(state.linked)).put(description);
    payload.put(static_cast<std::uint32_t>(state.samples.size()));
    for (const Sample& s : state.samples) {
        payload.put(s.frame).put(s.time).put(s.kinetic).put(s.spring).put(s.gravity).put(s.max_strain);
        payload.put(s.contacts).put(s.self_contacts).put(s.shortened_springs);
        for (const float seconds : s.stage_seconds)
            payload.put(seconds);
    }
    payload.append(state.compressed);
    chunks_.write(chunk::state, payload);
}

void RecordingWriter::write(const Mark& mark) {
    Packer payload;
    payload.put(static_cast<std::uint8_t>(mark.kind)).put(mark.step).put(mark.frame).put(mark.value).put(mark.text);
    chunks_.write(chunk::mark, payload);
}

void RecordingWriter::write(const sim::Trouble& trouble, std::uint64_t step) {
    Packer payload;
    payload.put(step).put(static_cast<std::uint8_t>(trouble.status)).put(trouble.time).put(trouble.frame);
    payload.put(trouble.column).put(trouble.row).put(trouble.cause);
    chunks_.write(chunk::trouble, payload);
}

void RecordingWriter::finish() {
    chunks_.write(chunk::end, Packer().put(chunks_.chunks()));
    chunks_.commit();
}

} // namespace clothlab::timeline
