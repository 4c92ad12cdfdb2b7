// What a run finds by itself, and on which branch it is found.
#include <algorithm>
#include <catch2/catch_test_macros.hpp>

#include "timeline/overview.h"

using namespace clothlab;
using namespace clothlab::timeline;

namespace {

/// Falls onto a sphere, and over its edges onto itself.
sim::Description falling_cloth() {
    sim::Description d;
    d.cloth.num_width_points = d.cloth.num_height_points = 14;
    d.cloth.thickness = 0.03;
    d.colliders = {sim::Sphere{{0.5, 0.85, 0.5}, 0.12, 0.3}};
    return d;
}

std::optional<MarkInfo> found(const Player& player, MarkKind kind) {
    const Overview o = overview(player);
    const auto mark = std::find_if(o.marks.begin(), o.marks.end(), [&](const MarkInfo& m) { return m.kind == kind; });
    if (mark == o.marks.end())
        return std::nullopt;
    REQUIRE(std::count_if(o.marks.begin(), o.marks.end(),
                          [&](const MarkInfo& m) { return m.kind == kind && m.branch == mark->branch; }) == 1);
    return *mark;
}

void frames(Player& player, int count) {
    for (int n = 0; n < 30 * count; ++n)
        player.step();
}

} // namespace

TEST_CASE("Contact, self-contact and the limit's first spring are marked at the very steps that they happen in") {
    Player player;
    player.start(falling_cloth());
    const auto straight = sim::Simulation::create(falling_cloth());
    std::uint64_t contact = 0, self_contact = 0, limit = 0;
    for (int n = 0; n < 30 * 60; ++n) {
        const sim::StepCounts counts = straight->step();
        const auto note = [&](std::uint64_t& step, std::size_t count) {
            if (step == 0 && count != 0)
                step = straight->steps();
        };
        note(contact, counts.contacts);
        note(self_contact, counts.self_contacts);
        note(limit, counts.shortened_springs);
    }
    frames(player, 60);
    REQUIRE(contact > 0);
    REQUIRE(found(player, MarkKind::first_contact)->step == contact);
    REQUIRE((self_contact > 0) == found(player, MarkKind::first_self_contact).has_value());
    if (self_contact > 0)
        REQUIRE(found(player, MarkKind::first_self_contact)->step == self_contact);
    REQUIRE(limit > 0);
    REQUIRE(found(player, MarkKind::limit_active)->step == limit);
}

TEST_CASE("The largest strain is marked at the frame that has it") {
    Player player;
    player.start(falling_cloth());
    frames(player, 60);
    const Overview o = overview(player);
    const auto highest = std::max_element(o.samples.begin(), o.samples.end(),
                                          [](const Sample& a, const Sample& b) { return a.max_strain < b.max_strain; });
    const auto peak = found(player, MarkKind::peak_strain);
    REQUIRE(peak);
    REQUIRE(peak->value <= highest->max_strain);
    REQUIRE(peak->value * 1.001 >= highest->max_strain); // what is higher by less is not worth another mark
}

TEST_CASE("A branch finds for itself what its line has not had when it began, and nothing a second time") {
    Player player;
    player.start(falling_cloth());
    frames(player, 60);
    const auto first = found(player, MarkKind::first_contact);
    REQUIRE(first);
    sim::Description heavier = falling_cloth();
    heavier.cloth.density = 300;
    for (const bool before : {true, false}) {
        player.switch_to(1);
        player.seek(before ? first->step - 60 : first->step + 60);
        player.change(heavier);
        const BranchId branch = player.line();
        frames(player, 10);
        const auto again = found(player, MarkKind::first_contact);
        REQUIRE(again);
        REQUIRE(again->branch == (before ? branch : 1));
        REQUIRE(overview(player).marks.size() >= 1);
    }
}

TEST_CASE("A blow-up is marked with its cause, and is known wherever the run is after it") {
    sim::Description stiff = falling_cloth();
    stiff.rules.limit = sim::LimitRule::off;
    Player player;
    player.start(stiff);
    frames(player, 3);
    stiff.cloth.ks = 5e6;
    player.change(stiff);
    int n = 0;
    while (!player.trouble() && ++n < 3000)
        player.step();
    const auto mark = found(player, MarkKind::blow_up);
    REQUIRE(mark);
    REQUIRE(mark->step == player.moment().step);
    REQUIRE(mark->text == player.trouble()->cause);
    player.seek(mark->step - 1);
    REQUIRE_FALSE(player.trouble());
    player.step();
    REQUIRE(player.trouble());
    // Another future, begun before it, has not had it.
    player.seek(60);
    stiff.cloth.ks = 4000;
    player.change(stiff);
    REQUIRE_FALSE(player.trouble());
    frames(player, 3);
    REQUIRE_FALSE(found(player, MarkKind::blow_up));
}
