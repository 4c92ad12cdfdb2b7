// Undo and redo of scene edits.
#pragma once

#include <optional>
#include <vector>

#include "scene/scene.h"

namespace clothlab::app {

/// Remembers what the scene was before each edit. Moving the camera is no edit: undo leaves it where it is.
class History {
public:
    /// Forgets everything; the scene is the first state.
    void restart(const scene::Scene& scene) {
        last_ = scene;
        undo_.clear();
        redo_.clear();
    }

    /// Call when no edit is under way: if the scene is no longer the last state, that becomes something to undo.
    void settle(const scene::Scene& scene) {
        if (same(scene, last_))
            return;
        undo_.push_back(last_);
        if (undo_.size() > depth)
            undo_.erase(undo_.begin());
        redo_.clear();
        last_ = scene;
    }

    /// The scene is another one by no edit of the user's: there is nothing to undo.
    void follow(const scene::Scene& scene) { last_ = scene; }

    bool can_undo() const { return !undo_.empty(); }
    bool can_redo() const { return !redo_.empty(); }
    /// The scene before the last edit; nothing when there is none.
    std::optional<scene::Scene> undo() { return move(undo_, redo_); }
    std::optional<scene::Scene> redo() { return move(redo_, undo_); }

private:
    static constexpr std::size_t depth = 200;

    static bool same(scene::Scene a, const scene::Scene& b) {
        a.camera = b.camera;
        return a == b;
    }
    std::optional<scene::Scene> move(std::vector<scene::Scene>& from, std::vector<scene::Scene>& to) {
        if (from.empty())
            return std::nullopt;
        to.push_back(last_);
        last_ = from.back();
        from.pop_back();
        return last_;
    }

    scene::Scene last_;
    std::vector<scene::Scene> undo_, redo_;
};

} // namespace clothlab::app
