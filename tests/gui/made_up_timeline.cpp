#include "made_up_timeline.h"

#include <cmath>

namespace clothlab::test {
namespace {

constexpr std::uint64_t substeps = 30;

timeline::MarkInfo mark(timeline::MarkKind kind, std::uint64_t step, double value, std::string text) {
    timeline::MarkInfo m;
    m.kind = kind;
    m.step = step;
    m.frame = step / substeps;
    m.value = value;
    m.text = std::move(text);
    m.branch = 2;
    return m;
}

timeline::Sample sample(std::uint64_t frame) {
    timeline::Sample s;
    s.frame = frame;
    s.time = static_cast<double>(frame) / 90;
    const auto t = static_cast<float>(s.time);
    const float falling = std::exp(-t / 3);
    s.gravity = 6.5f + 7 * falling * (0.6f + 0.4f * std::cos(2 * t));
    s.kinetic = 3 * falling * (1 - std::cos(4 * t));
    s.spring = 0.8f * (1 - falling) + 0.2f * falling * std::sin(9 * t) * std::sin(9 * t);
    s.max_strain = 0.07f * (1 - falling) + 0.03f * std::exp(-(t - 4) * (t - 4) * 4);
    s.contacts = frame < 60 ? 0 : static_cast<std::uint32_t>(400 * (1 - falling));
    s.self_contacts = frame < 500 ? 0 : static_cast<std::uint32_t>(120 + 60 * std::sin(3 * t));
    s.shortened_springs = frame < 120 ? 0 : static_cast<std::uint32_t>(300 * falling);
    s.stage_seconds = {31e-6f + 2e-6f * std::sin(50 * t), 12e-6f, frame < 500 ? 14e-6f : 22e-6f, 4e-6f, 9e-6f};
    return s;
}

} // namespace

std::shared_ptr<timeline::Overview> made_up_overview() {
    auto o = std::make_shared<timeline::Overview>();
    sim::Description start, stiff;
    stiff.cloth.ks = 8000;
    sim::Description damped = stiff;
    damped.cloth.damping = 1;
    const auto first = std::make_shared<const sim::Description>(start),
               second = std::make_shared<const sim::Description>(stiff),
               third = std::make_shared<const sim::Description>(damped);
    const std::uint64_t end = made_up_frames * substeps;
    o->version = 1;
    const auto branch = [&](timeline::BranchId id, const char* name, timeline::BranchId parent, int depth,
                            std::uint64_t fork_frame, std::uint64_t end_frame, std::size_t mb) {
        timeline::BranchInfo b;
        b.id = id;
        b.name = name;
        b.parent = parent;
        b.depth = depth;
        b.fork_step = fork_frame * substeps;
        b.fork_frame = fork_frame;
        b.end_step = end_frame * substeps;
        b.end_frame = end_frame;
        b.end_time = static_cast<double>(end_frame) / 90;
        b.keyframes = (end_frame - fork_frame) / 10;
        b.memory = mb << 20;
        o->branches.push_back(b);
    };
    branch(1, "run 1", 0, 0, 0, 1200, 118);
    branch(2, "stiffer", 1, 1, 400, made_up_frames, 164);
    o->branches.back().before = first;
    o->branches.back().after = second;
    branch(3, "more damping", 2, 2, 900, 1500, 51);
    o->branches.back().before = second;
    o->branches.back().after = third;
    o->line = 2;
    o->end_step = end;
    o->end_frame = made_up_frames;
    o->end_time = static_cast<double>(made_up_frames) / 90;
    o->reachable = {{0, 99}, {300, made_up_frames}};
    for (std::uint64_t frame = 0; frame <= made_up_frames; frame += 10)
        if (frame < 100 || frame >= 300)
            o->keyframes.push_back(frame);
    o->changes.push_back({400 * substeps, 400, 0, 2, first, second});
    using enum timeline::MarkKind;
    o->marks = {mark(first_contact, 1830, 0, "A point of the cloth touched the sphere for the first time."),
                mark(limit_active, 3607, 0, "The stretch limit shortened its first spring."),
                mark(peak_strain, 10800, 0.098, "The largest strain so far: 9.8 %."),
                mark(first_self_contact, 15012, 0, "Two layers of the cloth touched for the first time.")};
    timeline::Bookmark flag;
    flag.id = 1;
    flag.moment = {2, 13500};
    flag.frame = 450;
    flag.name = "watch this fold";
    flag.camera = scene::Camera{};
    timeline::Bookmark elsewhere;
    elsewhere.id = 2;
    elsewhere.moment = {3, 30012};
    elsewhere.frame = 1000;
    elsewhere.substep = 12;
    elsewhere.name = "at rest";
    o->bookmarks = {flag, elsewhere};
    for (std::uint64_t frame = 1; frame <= made_up_frames; ++frame)
        if (frame < 100 || frame >= 300)
            o->samples.push_back(sample(frame));
    o->memory = std::size_t{333} << 20;
    o->budget = std::size_t{512} << 20;
    o->disk = std::size_t{1} << 30;
    return o;
}

void show_made_up_timeline(ui::Lab& lab, std::uint64_t frame) {
    ui::TimelineWork& t = lab.timeline;
    t.overview = made_up_overview();
    t.playhead = {{2, frame * substeps},  frame, 0, static_cast<int>(substeps), static_cast<double>(frame) / 90,
                  frame == made_up_frames};
    t.ghost = 1;
    t.ghost_distance = timeline::Distance{0.0123, 0.045};
    auto curve = std::make_shared<std::vector<timeline::DistanceSample>>();
    for (std::uint64_t f = 400; f <= 1200; ++f) {
        const double s = static_cast<double>(f - 400) / 90;
        curve->push_back({f,
                          static_cast<double>(f) / 90,
                          {0.015 * (1 - std::exp(-s)), 0.05 * (1 - std::exp(-2 * s)) + 0.004 * std::sin(7 * s)}});
    }
    t.ghost_curve = curve;
    t.ghost_progress = 0.8;
    t.breakpoints = {{timeline::BreakpointKind::max_strain, 0.05},
                     {timeline::BreakpointKind::point_falls, 0.4, {49, 0}, true}};
    t.hit = 0;
}

} // namespace clothlab::test
