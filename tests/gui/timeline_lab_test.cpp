// What a lecturer does with the timeline in the window: the whole lab, driven by the test engine.
#include <imgui.h>

#include <catch2/catch_test_macros.hpp>

#include "lab_driver.h"
#include "render/image.h"
#include "support/files.h"
#include "ui/icons.h"

namespace clothlab::test {
namespace {

namespace fs = std::filesystem;

/// A lab that has simulated so many frames of a small cloth.
class Lecture {
public:
    explicit Lecture(int frames) : driver(scene(), LabDriver::options(1440, 900)) {
        driver.app().simulation().step_frames(frames);
        driver.settle();
    }
    ui::Lab& lab() { return driver.lab(); }
    const timeline::Overview& overview() { return *lab().timeline.overview; }
    bool press(ImGuiKeyChord key, int times = 1) {
        return driver.act([&](ImGuiTestContext* user) {
            user->MouseMoveToPos({720, 250}); // over nothing that takes keys
            for (int n = 0; n < times; ++n)
                user->KeyPress(key);
        });
    }
    bool click_in(const char* window, const char* item) {
        return driver.act([&](ImGuiTestContext* user) {
            user->WindowFocus(window);
            user->SetRef(window);
            user->ItemClick(item);
        });
    }
    std::uint64_t hash_of_positions() {
        std::uint64_t hash = 0;
        for (const float x : lab().snapshot->positions)
            hash = hash * 1099511628211u + std::bit_cast<std::uint32_t>(x);
        return hash;
    }
    /// As a slider does, let go at once.
    void set_ks(double ks) {
        lab().scene.simulation.cloth.ks = ks;
        driver.settle();
    }

    LabDriver driver;

private:
    static std::string scene() {
        static const TemporaryFolder folder;
        const fs::path file = folder / "lecture.json";
        scene::Scene s;
        s.name = "Lecture";
        s.simulation.cloth.num_width_points = s.simulation.cloth.num_height_points = 12;
        s.simulation.cloth.pinned = {{0, 0}, {11, 0}};
        s.simulation.colliders = {sim::Sphere{{0.5, 0.75, 0.5}, 0.2, 0.3}};
        scene::save_scene(s, file);
        return file.string();
    }
};

} // namespace

TEST_CASE("Keys step forth and back, to the start and to the end, and what is seen is what was seen before") {
    Lecture lecture(20);
    const std::uint64_t at_20 = lecture.hash_of_positions();
    REQUIRE(lecture.press(ImGuiKey_LeftArrow, 2));
    CHECK(lecture.lab().timeline.playhead.frame == 18);
    CHECK(lecture.lab().snapshot->frame == 18);
    REQUIRE(lecture.press(ImGuiMod_Shift | ImGuiKey_LeftArrow));
    CHECK(lecture.lab().snapshot->frame == 17);
    CHECK(lecture.lab().snapshot->substep == 29);
    REQUIRE(lecture.press(ImGuiMod_Shift | ImGuiKey_RightArrow));
    REQUIRE(lecture.press(ImGuiKey_RightArrow, 2));
    CHECK(lecture.hash_of_positions() == at_20);
    REQUIRE(lecture.press(ImGuiKey_Home));
    CHECK(lecture.lab().snapshot->steps == 0);
    REQUIRE(lecture.press(ImGuiKey_End));
    CHECK(lecture.hash_of_positions() == at_20);
    CHECK(lecture.overview().branches.size() == 1);
}

TEST_CASE("Dragging along the track shows each state at once, and pauses") {
    Lecture lecture(40);
    lecture.driver.app().simulation().play(true);
    std::vector<std::uint64_t> seen;
    REQUIRE(lecture.driver.act([&](ImGuiTestContext* user) {
        const ImRect track = user->ItemInfo("###Timeline/track").RectFull;
        const auto at = [&](float share) {
            return ImVec2{track.Min.x + share * track.GetWidth(), track.Min.y + 0.64f * track.GetHeight()};
        };
        user->MouseMoveToPos(at(0.1f));
        user->Yield(2);
        user->MouseDown();
        user->Yield(2);
        for (const float share : {0.2f, 0.4f, 0.6f, 0.3f}) {
            user->MouseMoveToPos(at(share));
            for (int n = 0; n < 3; ++n) {
                lecture.driver.app().simulation().finish();
                user->Yield();
            }
            seen.push_back(lecture.lab().snapshot->steps);
        }
        user->MouseUp();
    }));
    CHECK_FALSE(lecture.lab().playing);
    REQUIRE(seen.size() == 4);
    CHECK(seen[0] < seen[1]);
    CHECK(seen[1] < seen[2]);
    CHECK(seen[3] < seen[1]);
    CHECK(seen[3] > seen[0]);
}

TEST_CASE("A step back across a change of a parameter brings the slider's old value back, and forth the new one") {
    Lecture lecture(10);
    lecture.set_ks(800);
    lecture.driver.app().simulation().step_frames(5);
    lecture.driver.settle();
    REQUIRE(lecture.overview().changes.size() == 1);
    REQUIRE(lecture.press(ImGuiKey_LeftArrow, 6));
    CHECK(lecture.lab().snapshot->frame == 9);
    CHECK(lecture.lab().scene.simulation.cloth.ks == 5000);
    REQUIRE(lecture.press(ImGuiKey_RightArrow, 2));
    CHECK(lecture.lab().scene.simulation.cloth.ks == 800);
    CHECK(lecture.overview().branches.size() == 1); // looking is no edit
    CHECK_FALSE(lecture.lab().playing);
}

TEST_CASE("An edit after a rewind makes a branch, and both futures are listed, switched and drawn over each other") {
    Lecture lecture(30);
    const std::uint64_t old_end = lecture.hash_of_positions();
    REQUIRE(lecture.press(ImGuiKey_LeftArrow, 20));
    lecture.set_ks(600);
    REQUIRE(lecture.overview().branches.size() == 2);
    CHECK(lecture.overview().line == lecture.overview().branches[1].id);
    lecture.driver.app().simulation().step_frames(20);
    lecture.driver.settle();
    CHECK(lecture.hash_of_positions() != old_end);

    // The ghost: the old future over the new one, with their distance.
    REQUIRE(lecture.click_in("###Branches", "$$1/" ICON_FA_GHOST "##ghost"));
    for (int n = 0; n < 2000 && lecture.lab().timeline.ghost_progress < 1; ++n)
        lecture.driver.frame();
    const ui::TimelineWork& t = lecture.lab().timeline;
    CHECK(t.ghost == 1);
    REQUIRE(t.ghost_distance);
    CHECK(t.ghost_distance->rms > 0);
    CHECK(t.ghost_distance->max >= t.ghost_distance->rms);
    REQUIRE(t.ghost_curve);
    CHECK(t.ghost_curve->back().frame == 30);
    CHECK(t.ghost_curve->back().distance.rms == t.ghost_distance->rms);
    CHECK(lecture.driver.app().draw_report().ghost_triangles > 0);

    REQUIRE(lecture.click_in("###Branches", "$$1/###name"));
    CHECK(lecture.overview().line == 1);
    CHECK(lecture.lab().scene.simulation.cloth.ks == 5000);
    CHECK(lecture.hash_of_positions() == old_end);
    CHECK(lecture.lab().timeline.ghost == 0); // no branch is its own ghost
}

TEST_CASE("Undoing the edit that made a branch is the old future again, with no branch left") {
    Lecture lecture(30);
    REQUIRE(lecture.press(ImGuiKey_LeftArrow, 20));
    lecture.set_ks(600);
    REQUIRE(lecture.overview().branches.size() == 2);
    REQUIRE(lecture.press(ImGuiMod_Ctrl | ImGuiKey_Z));
    CHECK(lecture.overview().branches.size() == 1);
    CHECK(lecture.lab().scene.simulation.cloth.ks == 5000);
    REQUIRE(lecture.press(ImGuiKey_End));
    CHECK(lecture.lab().snapshot->frame == 30);
}

TEST_CASE("A breakpoint pauses the run where its condition becomes true, and the panels say which") {
    Lecture lecture(0);
    lecture.lab().ask(ui::Request(
        ui::TimelineRequest(ui::SetBreakpoints{{{timeline::BreakpointKind::sphere_contact, 0, {0, 0}, false, true}}})));
    lecture.driver.settle();
    REQUIRE(lecture.press(ImGuiKey_Space));
    for (int n = 0; n < 100000 && !lecture.lab().timeline.hit; ++n)
        lecture.driver.frame();
    REQUIRE(lecture.lab().timeline.hit == 0);
    lecture.driver.settle();
    CHECK_FALSE(lecture.lab().playing);
    CHECK(lecture.lab().snapshot->counts.sphere_contacts > 0);
    const auto& marks = lecture.overview().marks;
    const auto contact = std::find_if(marks.begin(), marks.end(), [](const timeline::MarkInfo& m) {
        return m.kind == timeline::MarkKind::first_contact;
    });
    REQUIRE(contact != marks.end());
    CHECK(contact->step == lecture.lab().snapshot->steps);
    REQUIRE_FALSE(lecture.lab().messages.empty());
    CHECK(lecture.lab().messages.back().text.find("sphere") != std::string::npos);
}

TEST_CASE("A bookmark brings back its moment and its camera") {
    Lecture lecture(15);
    const scene::Camera camera = *lecture.lab().scene.camera;
    REQUIRE(lecture.press(ImGuiKey_M));
    REQUIRE(lecture.overview().bookmarks.size() == 1);
    lecture.lab().scene.camera->yaw += 60;
    REQUIRE(lecture.press(ImGuiKey_Home));
    const timeline::Bookmark bookmark = lecture.overview().bookmarks[0];
    lecture.lab().ask(ui::Request(ui::TimelineRequest(ui::GoToMoment{bookmark.moment, bookmark.camera})));
    lecture.driver.settle();
    lecture.driver.settle();
    CHECK(lecture.lab().snapshot->frame == 15);
    CHECK(lecture.lab().scene.camera == camera);
}

TEST_CASE("A recording brings a whole session back: branches, bookmarks, the moment and the look") {
    const TemporaryFolder folder;
    const fs::path file = folder / "session.clothrec";
    std::uint64_t seen = 0;
    {
        Lecture lecture(20);
        lecture.lab().scene.look.shader = "strain";
        REQUIRE(lecture.press(ImGuiKey_LeftArrow, 12));
        lecture.set_ks(700);
        lecture.driver.app().simulation().step_frames(4);
        lecture.driver.settle();
        REQUIRE(lecture.press(ImGuiKey_M));
        seen = lecture.hash_of_positions();
        lecture.lab().ask(ui::Request(ui::TimelineRequest(ui::SaveRecording{file, false})));
        lecture.driver.settle();
        for (int n = 0; n < 100000 && !fs::exists(file); ++n)
            lecture.driver.frame();
        lecture.driver.settle();
    }
    Lecture lecture(3);
    lecture.lab().ask(ui::OpenScene{file});
    for (int n = 0; n < 100000 && (!lecture.lab().timeline.overview || lecture.overview().branches.size() < 2); ++n)
        lecture.driver.frame();
    lecture.driver.settle();
    REQUIRE(lecture.overview().branches.size() == 2);
    CHECK(lecture.overview().bookmarks.size() == 1);
    CHECK(lecture.hash_of_positions() == seen);
    CHECK(lecture.lab().scene.simulation.cloth.ks == 700);
    CHECK(lecture.lab().scene.look.shader == "strain");
    REQUIRE(lecture.press(ImGuiKey_Home));
    CHECK(lecture.lab().snapshot->steps == 0);
    CHECK(lecture.lab().scene.simulation.cloth.ks == 5000);
}

TEST_CASE("Stages of the next step are shown while the panel for them is seen, and the run is as if nobody looked") {
    std::uint64_t looked_at = 0;
    {
        Lecture lecture(12);
        lecture.lab().open[static_cast<std::size_t>(ui::PanelId::step)] = true;
        REQUIRE(lecture.driver.act([](ImGuiTestContext* user) { user->WindowFocus("###Inside a step"); }));
        lecture.driver.settle();
        REQUIRE(lecture.lab().timeline.trace);
        CHECK(lecture.lab().timeline.trace->step == 360);
        lecture.lab().open[static_cast<std::size_t>(ui::PanelId::step)] = false;
        lecture.driver.app().simulation().step_frames(3);
        lecture.driver.settle();
        looked_at = lecture.hash_of_positions();
        CHECK_FALSE(lecture.lab().timeline.trace);
    }
    Lecture other(15);
    CHECK(other.hash_of_positions() == looked_at);
}

// Not run by default: `clothlab_gui_tests "[draw-timeline]"` draws the pictures of docs/timeline.md.
TEST_CASE("Draw the timeline's pictures", "[.][draw-timeline]") {
    LabDriver driver("sphere-medium", LabDriver::options(1440, 900));
    scene::Camera& camera = *driver.lab().scene.camera;
    camera.target = {0.5, 0.28, 0.5};
    camera.distance = 1.5;
    const auto frames = [&](int count) {
        driver.app().simulation().step_frames(count);
        driver.settle();
    };
    const auto ask = [&](ui::TimelineRequest request) {
        driver.lab().ask(ui::Request(std::move(request)));
        driver.settle();
        driver.settle();
    };
    const auto picture = [&](const char* panel, const char* name) {
        REQUIRE(driver.act([&](ImGuiTestContext* user) {
            user->WindowFocus(panel);
            user->MouseMoveToPos({700, 120});
        }));
        driver.settle();
        render::write_png(driver.app().picture(), checkout() / "docs/pictures" / name);
    };
    frames(60);
    ask(ui::AddBookmark{"on the sphere"});
    frames(60);
    ask(ui::SeekStep{40 * 30});
    driver.lab().scene.simulation.cloth.ks = 500;
    driver.settle();
    frames(50);
    ask(ui::ShowGhost{1});
    for (int n = 0; n < 2000 && driver.lab().timeline.ghost_progress < 1; ++n)
        driver.frame();
    ask(ui::SetBreakpoints{{{timeline::BreakpointKind::max_strain, 0.05, {0, 0}, false, true},
                            {timeline::BreakpointKind::point_falls, 0.3, {0, 49}, true, true}}});
    picture("###Branches", "timeline.png");
    picture("###Moments", "moments.png");
    ask(ui::ShowGhost{0});
    ask(ui::SwitchBranch{1});
    ask(ui::SeekStep{46 * 30});
    driver.lab().open[static_cast<std::size_t>(ui::PanelId::step)] = true;
    driver.settle();
    driver.settle();
    driver.lab().timeline.stage = static_cast<int>(sim::Stage::colliders);
    picture("###Inside a step", "step.png");
}

} // namespace clothlab::test
