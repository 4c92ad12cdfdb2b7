#include <algorithm>
#include <limits>

#include "scene/error.h"
#include "scene/io.h"
#include "timeline/recording.h"
#include "timeline/recording_writer.h"

namespace clothlab::timeline {
namespace {

struct InFile final : StoredState {
    InFile(std::shared_ptr<const SharedFile> f, std::uint64_t a, std::span<const std::byte> bytes)
        : file(std::move(f)), at(a), count(bytes.size()), checksum(sim::checksum(bytes)) {}
    std::vector<std::byte> compressed() const override {
        std::vector<std::byte> bytes = file->read(at, count);
        if (bytes.size() != count || sim::checksum(bytes) != checksum)
            throw std::runtime_error(file->name() + ": the recording was changed while it was in use");
        return bytes;
    }
    std::size_t memory() const override { return sizeof *this; }

    std::shared_ptr<const SharedFile> file;
    std::uint64_t at;
    std::size_t count;
    std::uint64_t checksum;
};

void require(bool right, const char* what) {
    if (!right)
        throw Damage(what);
}

/// Text of a payload.
std::string_view text_of(const Chunk& chunk) {
    return {reinterpret_cast<const char*>(chunk.payload.data()), chunk.payload.size()};
}

/// What contents says of a branch.
struct Promised {
    BranchId id = 0;
    std::string name;
    std::uint64_t end = 0, last_frame = 0;
};

class Loader {
public:
    Loader(const std::filesystem::path& file, const Progress& progress)
        : name_(file.string()), progress_(progress),
          reader_(std::make_shared<const SharedFile>(file), recording_magic, recording_version) {}

    Recording load() {
        std::string damage;
        try {
            read_all();
        } catch (const RecordingError&) {
            throw;
        } catch (const std::runtime_error& e) { // damage, a scene that is none, or a disk that cannot be read
            damage = e.what();
        }
        add_branch();
        if (!has_scene_ || timeline_.branches().empty())
            throw RecordingError(place() + damage + "; nothing of it can be used");
        if (!damage.empty())
            damage = place() + damage + ". What comes before that was loaded; " + missing() + ".";
        for (const Bookmark& b : bookmarks_)
            if (const Branch* branch = timeline_.find(b.moment.branch); branch && b.moment.step <= branch->end)
                timeline_.add_bookmark(b.moment, b.name, b.camera);
        std::vector<BranchId> ids;
        for (const Branch& branch : timeline_.branches())
            ids.push_back(branch.id);
        for (const BranchId id : ids)
            timeline_.refresh_kept(id);
        Moment at = playhead_.value_or(Moment{});
        if (!timeline_.find(at.branch))
            at = {ids.back(), timeline_.branches().back().end};
        at.step = timeline_.nearest_reachable(at);
        return {std::move(scene_), std::move(timeline_), at, std::move(damage)};
    }

private:
    std::string place() const {
        return name_ + ": damaged at byte " + std::to_string(reader_.at()) + " of " + std::to_string(reader_.size()) +
               ", in chunk " + std::to_string(reader_.number()) + ": ";
    }

    void read_all() {
        for (;;) {
            const std::optional<Chunk> chunk = reader_.next();
            if (!chunk)
                throw Damage("the end is missing");
            if (chunk->kind == chunk::end) {
                Unpacker payload(chunk->payload);
                require(payload.get<std::uint32_t>() == reader_.number(), "the end's count of chunks is wrong");
                payload.end();
                require(reader_.at_end(), "something follows the end");
                return;
            }
            take(*chunk);
            if (progress_ && !progress_(static_cast<double>(reader_.at()) / static_cast<double>(reader_.size())))
                throw RecordingError(name_ + ": loading was cancelled");
        }
    }

    void take(const Chunk& chunk) {
        require(has_scene_ || chunk.kind == chunk::scene, "the scene is missing");
        Unpacker payload(chunk.payload);
        if (chunk.kind == chunk::scene) {
            require(!has_scene_, "a second scene");
            scene_ = scene::read_scene(text_of(chunk), "the scene in it");
            has_scene_ = true;
            return;
        }
        if (chunk.kind == chunk::description) {
            descriptions_.push_back(std::make_shared<const sim::Description>(
                scene::read_scene(text_of(chunk), "a description in it").simulation));
            return;
        }
        if (chunk.kind == chunk::state)
            return take_state(chunk, payload);
        if (chunk.kind == chunk::contents)
            take_contents(payload);
        else if (chunk.kind == chunk::playhead)
            take_playhead(payload);
        else if (chunk.kind == chunk::bookmark)
            take_bookmark(payload);
        else if (chunk.kind == chunk::branch)
            take_branch(payload);
        else if (chunk.kind == chunk::change)
            take_change(payload);
        else if (chunk.kind == chunk::clock)
            take_clock(payload);
        else if (chunk.kind == chunk::mark)
            take_mark(payload);
        else if (chunk.kind == chunk::trouble)
            take_trouble(payload);
        else
            throw Damage("a chunk of an unknown kind");
        payload.end();
    }

    void take_contents(Unpacker& payload) {
        require(promised_.empty(), "a second list of contents");
        for (auto n = payload.get<std::uint32_t>(); n-- > 0;) {
            Promised& p = promised_.emplace_back();
            payload.get(p.id);
            p.name = payload.text();
            payload.get(p.end);
            payload.get(p.last_frame);
        }
    }

    void take_playhead(Unpacker& payload) {
        playhead_.emplace();
        payload.get(playhead_->branch);
        payload.get(playhead_->step);
    }

    void take_bookmark(Unpacker& payload) {
        Bookmark& b = bookmarks_.emplace_back();
        payload.get(b.moment.branch);
        payload.get(b.moment.step);
        b.name = payload.text();
        if (const std::string camera = payload.text(); !camera.empty())
            b.camera = scene::read_camera(camera, "a bookmark's camera in it");
    }

    DescriptionPtr take_description(Unpacker& payload) {
        const auto number = payload.get<std::uint32_t>();
        require(number < descriptions_.size(), "a description is missing");
        return descriptions_[number];
    }

    void take_branch(Unpacker& payload) {
        require(!branch_ || !branch_->keyframes.empty(), "a branch has no states");
        add_branch();
        Branch branch;
        payload.get(branch.id);
        branch.name = payload.text();
        payload.get(branch.parent);
        payload.get(branch.fork_step);
        branch.stem = payload.get<std::uint8_t>() != 0;
        branch.start = take_description(payload);
        branch.end = branch.fork_step;
        const Branch* parent = timeline_.find(branch.parent);
        require(branch.id != 0 && branch.id < std::numeric_limits<BranchId>::max() && !timeline_.find(branch.id),
                "two branches have one number");
        require(branch.parent == 0 ||
                    (parent && branch.fork_step >= parent->fork_step && branch.fork_step <= parent->end),
                "a branch without its parent");
        branch_ = std::move(branch);
    }

    /// The branch under way, whose parts are not before `step`.
    Branch& branch_at(std::uint64_t step) {
        require(branch_.has_value(), "a part of a branch without its head");
        require(step >= branch_->end, "steps do not ascend");
        return *branch_;
    }

    void take_change(Unpacker& payload) {
        Change change;
        payload.get(change.step);
        change.description = take_description(payload);
        Branch& branch = branch_at(change.step);
        require(branch.changes.empty() || branch.changes.back().step <= change.step, "steps do not ascend");
        require(sim::can_change_live(*branch.start, *change.description), "a change that no run can make");
        branch.changes.push_back(std::move(change));
    }

    void take_clock(Unpacker& payload) {
        FrameClock clock;
        payload.get(clock.step);
        payload.get(clock.frame);
        payload.get(clock.substep);
        payload.get(clock.substeps);
        payload.get(clock.time);
        payload.get(clock.dt);
        Branch& branch = branch_at(clock.step);
        require(branch.clocks.empty() ? clock.step == branch.fork_step : branch.clocks.back().step < clock.step,
                "steps do not ascend");
        require(clock.substeps >= 1 && clock.substep >= 0 && clock.substep < clock.substeps && clock.dt > 0,
                "a clock that cannot be");
        branch.clocks.push_back(clock);
    }

    void take_state(const Chunk& chunk, Unpacker& payload) {
        Keyframe keyframe;
        payload.get(keyframe.step);
        const bool linked = payload.get<std::uint8_t>() != 0;
        keyframe.description = take_description(payload);
        Branch& branch = branch_at(keyframe.step);
        require(!branch.clocks.empty(), "a state without a clock");
        require(branch.keyframes.empty() || keyframe.step > branch.keyframes.back().step, "steps do not ascend");
        std::vector<Sample> samples;
        for (auto n = payload.get<std::uint32_t>(); n-- > 0;) {
            Sample& s = samples.emplace_back();
            payload.get(s.frame);
            payload.get(s.time);
            for (float* number : {&s.kinetic, &s.spring, &s.gravity, &s.max_strain})
                payload.get(*number);
            for (std::uint32_t* number : {&s.contacts, &s.self_contacts, &s.shortened_springs})
                payload.get(*number);
            for (float& seconds : s.stage_seconds)
                payload.get(seconds);
            const Sample* before = samples.size() > 1        ? &samples[samples.size() - 2]
                                   : !branch.samples.empty() ? &branch.samples.back()
                                                             : nullptr;
            require(!before || before->frame < s.frame, "frames do not ascend");
        }
        if (payload.left() == 0) {
            require(branch.parent == 0 && branch.keyframes.empty() && keyframe.step == branch.fork_step &&
                        keyframe.step == 0,
                    "a state is missing");
        } else {
            keyframe.state = stored(chunk, payload, keyframe);
        }
        if (linked && !branch.keyframes.empty())
            branch.keyframes.back().until = keyframe.step;
        branch.end = keyframe.until = keyframe.step;
        branch.keyframes.push_back(std::move(keyframe));
        branch.samples.insert(branch.samples.end(), samples.begin(), samples.end());
    }

    StoredStatePtr stored(const Chunk& chunk, const Unpacker& payload, const Keyframe& keyframe) const {
        const sim::Description& d = *keyframe.description;
        try {
            const sim::StateHeader header = compressed_header(payload.rest());
            const bool single = d.stepping.precision == sim::Precision::single_precision;
            require(header.steps == keyframe.step && header.columns == d.cloth.num_width_points &&
                        header.rows == d.cloth.num_height_points &&
                        header.real_size == (single ? sizeof(float) : sizeof(double)) &&
                        sim::can_change_live(*branch_->start, d),
                    "a state of something else");
        } catch (const std::invalid_argument& e) {
            throw Damage(e.what());
        }
        const std::size_t before = chunk.payload.size() - payload.left();
        return std::make_shared<InFile>(reader_.file(), chunk.payload_at + before, payload.rest());
    }

    void take_mark(Unpacker& payload) {
        Mark mark;
        const auto kind = payload.get<std::uint8_t>();
        require(kind < mark_kinds, "a mark of an unknown kind");
        mark.kind = static_cast<MarkKind>(kind);
        payload.get(mark.step);
        payload.get(mark.frame);
        payload.get(mark.value);
        mark.text = payload.text();
        require(branch_ && mark.step <= branch_->end &&
                    (branch_->marks.empty() || branch_->marks.back().step <= mark.step),
                "a mark where there are no steps");
        branch_->marks.push_back(std::move(mark));
    }

    void take_trouble(Unpacker& payload) {
        const auto step = payload.get<std::uint64_t>();
        const auto status = payload.get<std::uint8_t>();
        require(branch_ && step <= branch_->end && status <= static_cast<std::uint8_t>(sim::Status::diverged),
                "a trouble where there are no steps");
        sim::Trouble trouble;
        trouble.status = static_cast<sim::Status>(status);
        payload.get(trouble.time);
        payload.get(trouble.frame);
        payload.get(trouble.column);
        payload.get(trouble.row);
        trouble.cause = payload.text();
        branch_->trouble = std::move(trouble);
        branch_->trouble_step = step;
    }

    /// The branch under way is over, as far as it has states.
    void add_branch() {
        if (branch_ && !branch_->keyframes.empty()) {
            const auto later = [&](const auto& x) { return x.step > branch_->end; };
            std::erase_if(branch_->changes, later);
            std::erase_if(branch_->clocks, later);
            timeline_.add(std::move(*branch_));
        }
        branch_.reset();
    }

    /// As the end of a sentence.
    std::string missing() const {
        std::string list;
        const auto add = [&](const std::string& what) { list += (list.empty() ? "" : ", ") + what; };
        for (const Promised& p : promised_) {
            const Branch* branch = timeline_.find(p.id);
            if (!branch)
                add("all of \"" + p.name + "\"");
            else if (branch->end < p.end)
                add("what comes after frame " + std::to_string(frame_time(*branch, branch->end).frame) + " of \"" +
                    p.name + "\", which had " + std::to_string(p.last_frame));
        }
        if (promised_.empty()) {
            const Branch& last = timeline_.branches().back();
            add("what comes after frame " + std::to_string(frame_time(last, last.end).frame) + " of \"" + last.name +
                "\"");
        }
        return list.empty() ? "no state is missing" : "missing: " + list;
    }

    std::string name_;
    const Progress& progress_;
    ChunkReader reader_;
    bool has_scene_ = false;
    scene::Scene scene_;
    std::vector<Promised> promised_;
    std::optional<Moment> playhead_;
    std::vector<Bookmark> bookmarks_;
    std::vector<DescriptionPtr> descriptions_;
    std::optional<Branch> branch_;
    Timeline timeline_;
};

} // namespace

bool is_recording(const std::filesystem::path& file) {
    try {
        const std::vector<std::byte> begin = SharedFile(file).read(0, sizeof recording_magic);
        return begin.size() == sizeof recording_magic && Unpacker(begin).get<std::uint64_t>() == recording_magic;
    } catch (const std::runtime_error&) {
        return false;
    }
}

Recording load_recording(const std::filesystem::path& file, const Progress& progress) {
    try {
        return Loader(file, progress).load();
    } catch (const RecordingError&) {
        throw;
    } catch (const Damage& e) {
        throw RecordingError(file.string() + ": " + e.what());
    } catch (const std::exception& e) { // it cannot be read, or no memory
        const std::string what = e.what();
        throw RecordingError(what.rfind(file.string(), 0) == 0 ? what : file.string() + ": cannot be read: " + what);
    }
}

} // namespace clothlab::timeline
