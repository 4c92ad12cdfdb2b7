#include "ui/track_places.h"

#include "ui/change_text.h"
#include "ui/icons.h"
#include "ui/theme.h"

namespace clothlab::ui {

MarkLook look_of(timeline::MarkKind kind) {
    // Colours that people with any kind of colour blindness can tell apart (M. Okabe, K. Ito, "Color universal design",
    // 2008); the icons say the same.
    static constexpr MarkLook looks[] = {
        {ICON_FA_CIRCLE_DOT, {0.34f, 0.71f, 0.91f, 1}},        // first contact
        {ICON_FA_LAYER_GROUP, {0.80f, 0.47f, 0.65f, 1}},       // first self-contact
        {ICON_FA_COMPRESS, {0.90f, 0.62f, 0.00f, 1}},          // limit active
        {ICON_FA_ARROWS_LEFT_RIGHT, {0.94f, 0.89f, 0.26f, 1}}, // peak strain
        {ICON_FA_WAVE_SQUARE, {0.95f, 0.73f, 0.30f, 1}},       // jitter
        {ICON_FA_BURST, {0.95f, 0.42f, 0.40f, 1}},             // blow-up
    };
    static_assert(std::size(looks) == timeline::mark_kinds);
    return looks[static_cast<std::size_t>(kind)];
}

std::vector<TrackPlace> track_places(const timeline::Overview& o, const FrameAxis& axis) {
    using Kind = TrackPlace::Kind;
    std::vector<TrackPlace> places;
    const auto add = [&](Kind kind, std::uint64_t step, std::string text, const char* icon, const ImVec4& tint) {
        places.push_back({kind, step, axis.frame_of(step), std::move(text), icon, tint, {}});
    };
    for (const timeline::BranchInfo& b : o.branches)
        if (b.parent != 0 && !b.stem && on_line(o, {b.parent, b.fork_step}))
            add(Kind::fork, b.fork_step, "Branch \"" + b.name + "\" begins here", ICON_FA_CODE_BRANCH, colour::faint);
    for (const timeline::ChangeInfo& c : o.changes)
        add(Kind::change, c.step, c.before && c.after ? describe_change(*c.before, *c.after) : "Parameters changed",
            ICON_FA_SLIDERS, colour::text);
    for (const timeline::MarkInfo& m : o.marks)
        add(Kind::mark, m.step, m.text, look_of(m.kind).icon, look_of(m.kind).colour);
    for (const timeline::Bookmark& b : o.bookmarks) {
        if (!on_line(o, b.moment))
            continue;
        add(Kind::bookmark, b.moment.step, b.name, ICON_FA_FLAG, colour::accent);
        places.back().camera = b.camera;
    }
    return places;
}

} // namespace clothlab::ui
