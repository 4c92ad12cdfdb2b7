// The panels Branches and Moments, and the windows for recordings and meshes: what each control asks for.
#include <imgui.h>

#include <catch2/catch_test_macros.hpp>
#include <fstream>

#include "made_up_timeline.h"
#include "panel_driver.h"
#include "support/files.h"
#include "ui/breakpoint_rows.h"
#include "ui/icons.h"

namespace clothlab::test {
namespace {

using timeline::Breakpoint;
using timeline::BreakpointKind;

/// The made-up timeline with a panel in front.
struct Panel {
    PanelDriver driver;
    explicit Panel(const char* window) {
        show_made_up_timeline(driver.lab);
        driver.settle();
        REQUIRE(driver.act([&](ImGuiTestContext* user) { user->WindowFocus(window); }));
        driver.settle();
    }
};

std::vector<Breakpoint> set_by(PanelDriver& driver, const std::function<void(ImGuiTestContext*)>& user) {
    REQUIRE(driver.act(user));
    const auto set = driver.asked<ui::SetBreakpoints>();
    REQUIRE(set.size() == 1);
    CHECK(driver.requests.size() == 1);
    return set[0].breakpoints;
}

} // namespace

TEST_CASE("A click on a branch shows it, one on the branch that is shown does nothing") {
    Panel p("###Branches");
    REQUIRE(p.driver.act([](ImGuiTestContext* user) { user->ItemClick("###Branches/$$3/###name"); }));
    REQUIRE(p.driver.asked<ui::SwitchBranch>().size() == 1);
    CHECK(p.driver.asked<ui::SwitchBranch>()[0].branch == 3);
    REQUIRE(p.driver.act([](ImGuiTestContext* user) { user->ItemClick("###Branches/$$2/###name"); }));
    CHECK(p.driver.requests.empty());
}

TEST_CASE("A double click on a branch renames it, Escape leaves it as it was") {
    Panel p("###Branches");
    REQUIRE(p.driver.act([](ImGuiTestContext* user) {
        user->ItemDoubleClick("###Branches/$$2/###name");
        user->Yield(2);
        user->ItemInputValue("###Branches/$$2/##rename", "much stiffer");
    }));
    REQUIRE(p.driver.asked<ui::RenameBranch>().size() == 1);
    CHECK(p.driver.asked<ui::RenameBranch>()[0].branch == 2);
    CHECK(p.driver.asked<ui::RenameBranch>()[0].name == "much stiffer");
    REQUIRE(p.driver.act([](ImGuiTestContext* user) {
        user->ItemDoubleClick("###Branches/$$2/###name");
        user->Yield(2);
        user->KeyChars("something else");
        user->KeyPress(ImGuiKey_Escape);
    }));
    CHECK(p.driver.asked<ui::RenameBranch>().empty());
    CHECK_FALSE(p.driver.lab.timeline_view.renaming);
}

TEST_CASE("The ghost button switches a branch's ghost on, and off again, and the branch shown has none") {
    Panel p("###Branches");
    REQUIRE(p.driver.act([](ImGuiTestContext* user) { user->ItemClick("###Branches/$$3/" ICON_FA_GHOST "##ghost"); }));
    REQUIRE(p.driver.asked<ui::ShowGhost>().size() == 1);
    CHECK(p.driver.asked<ui::ShowGhost>()[0].branch == 3);
    REQUIRE(p.driver.act([](ImGuiTestContext* user) { user->ItemClick("###Branches/$$1/" ICON_FA_GHOST "##ghost"); }));
    REQUIRE(p.driver.asked<ui::ShowGhost>().size() == 1);
    CHECK(p.driver.asked<ui::ShowGhost>()[0].branch == 0); // it was on
    REQUIRE(p.driver.act([](ImGuiTestContext* user) {
        IM_CHECK((user->ItemInfo("###Branches/$$2/" ICON_FA_GHOST "##ghost").ItemFlags & ImGuiItemFlags_Disabled) != 0);
    }));
}

TEST_CASE("A branch is deleted after a question, and not when the answer is no") {
    Panel p("###Branches");
    const char* bin = "###Branches/$$3/" ICON_FA_TRASH "##delete";
    REQUIRE(p.driver.act([&](ImGuiTestContext* user) {
        user->ItemClick(bin);
        user->Yield(2);
        user->ItemClick("//$FOCUSED/Cancel");
    }));
    CHECK(p.driver.requests.empty());
    REQUIRE(p.driver.act([&](ImGuiTestContext* user) {
        user->ItemClick(bin);
        user->Yield(2);
        user->ItemClick("//$FOCUSED/###yes");
    }));
    REQUIRE(p.driver.asked<ui::RemoveBranch>().size() == 1);
    CHECK(p.driver.asked<ui::RemoveBranch>()[0].branch == 3);
}

TEST_CASE("A bookmark is added with its name, gone to with its camera, renamed and removed") {
    Panel p("###Moments");
    REQUIRE(
        p.driver.act([](ImGuiTestContext* user) { user->ItemInputValue("###Moments/bookmarks/##name", "the fold"); }));
    REQUIRE(p.driver.asked<ui::AddBookmark>().size() == 1);
    CHECK(p.driver.asked<ui::AddBookmark>()[0].name == "the fold");
    CHECK(p.driver.lab.timeline_view.bookmark_name.empty());
    REQUIRE(p.driver.act([](ImGuiTestContext* user) {
        user->ItemClick("###Moments/bookmarks/$$1/" ICON_FA_FLAG "##go");
        user->ItemClick("###Moments/bookmarks/$$2/###name");
    }));
    const auto gone = p.driver.asked<ui::GoToMoment>();
    REQUIRE(gone.size() == 2);
    CHECK(gone[0].moment == timeline::Moment{2, 13500});
    CHECK(gone[0].camera);
    CHECK(gone[1].moment == timeline::Moment{3, 30012}); // on a branch that is not shown
    CHECK_FALSE(gone[1].camera);
    REQUIRE(p.driver.act([](ImGuiTestContext* user) {
        user->ItemDoubleClick("###Moments/bookmarks/$$1/###name");
        user->Yield(2);
        user->ItemInputValue("###Moments/bookmarks/$$1/##rename", "this one");
        user->ItemClick("###Moments/bookmarks/$$2/" ICON_FA_TRASH "##delete");
    }));
    REQUIRE(p.driver.asked<ui::RenameBookmark>().size() == 1);
    CHECK(p.driver.asked<ui::RenameBookmark>()[0].name == "this one");
    REQUIRE(p.driver.asked<ui::RemoveBookmark>().size() == 1);
    CHECK(p.driver.asked<ui::RemoveBookmark>()[0].bookmark == 2);
}

TEST_CASE("A click on an event goes to its step on the line shown") {
    Panel p("###Moments");
    REQUIRE(p.driver.act([](ImGuiTestContext* user) { user->ItemClick("###Moments/events/$$2/###event"); }));
    REQUIRE(p.driver.asked<ui::GoToMoment>().size() == 1);
    CHECK(p.driver.asked<ui::GoToMoment>()[0].moment == timeline::Moment{2, 10800});
}

TEST_CASE("Breakpoints are switched, added and removed") {
    Panel p("###Moments");
    const auto before = p.driver.lab.timeline.breakpoints;
    auto list = set_by(p.driver, [](ImGuiTestContext* user) { user->ItemClick("###Moments/breakpoints/$$0/##on"); });
    REQUIRE(list.size() == 2);
    CHECK_FALSE(list[0].on);
    CHECK(list[1] == before[1]);
    list = set_by(p.driver, [](ImGuiTestContext* user) { user->ItemClick("###Moments/breakpoints/###add"); });
    REQUIRE(list.size() == 3);
    CHECK(list[2].on);
    list = set_by(p.driver, [](ImGuiTestContext* user) {
        user->ItemClick("###Moments/breakpoints/$$0/" ICON_FA_TRASH "##remove");
    });
    REQUIRE(list.size() == 1);
    CHECK(list[0] == before[1]);
}

TEST_CASE("A breakpoint's strain is typed in percent and kept as a fraction, a height is in metres") {
    Panel p("###Moments");
    auto list = set_by(
        p.driver, [](ImGuiTestContext* user) { user->ItemInputValue("###Moments/breakpoints/$$0/##value", "12"); });
    CHECK(list[0].value == 0.12);
    list = set_by(p.driver,
                  [](ImGuiTestContext* user) { user->ItemInputValue("###Moments/breakpoints/$$1/##value", "0.25"); });
    CHECK(list[1].value == 0.25);
}

TEST_CASE("A breakpoint's kind, point and side of the step are chosen, and a point outside the grid is its edge") {
    Panel p("###Moments");
    const auto& gain = timeline::breakpoint_info()[static_cast<std::size_t>(BreakpointKind::energy_gain)];
    auto list = set_by(p.driver, [&](ImGuiTestContext* user) {
        user->ItemClick("###Moments/breakpoints/$$0/##kind");
        user->Yield(2);
        user->ItemClick(("//$FOCUSED/" + std::string(gain.name)).c_str());
    });
    CHECK(list[0].kind == BreakpointKind::energy_gain);
    CHECK(list[0].value == gain.value);
    list = set_by(p.driver,
                  [](ImGuiTestContext* user) { user->ItemInputValue("###Moments/breakpoints/$$1/##point/$$1", 500); });
    CHECK(list[1].point == sim::GridPoint{49, 49});
    list = set_by(p.driver, [](ImGuiTestContext* user) {
        user->ItemClick("###Moments/breakpoints/$$1/##side");
        user->Yield(2);
        user->ItemClick("//$FOCUSED/after the step");
    });
    CHECK_FALSE(list[1].before);
}

TEST_CASE("A recording is saved with its suffix, and over a file that is there only by a click on Replace") {
    const TemporaryFolder folder;
    PanelDriver driver;
    show_made_up_timeline(driver.lab);
    const auto name = folder / "fold";
    const auto save = [&](bool click) {
        driver.lab.timeline_view.files.save = true;
        REQUIRE(driver.act([&](ImGuiTestContext* user) {
            user->Yield(2);
            user->SetRef("//$FOCUSED");
            user->ItemInputValue("##path", name.string().c_str());
            user->Yield(2);
            if (click)
                user->ItemClick("###done");
            else if (user->ItemExists("Cancel"))
                user->ItemClick("Cancel");
        }));
        return driver.asked<ui::SaveRecording>();
    };
    auto saved = save(false);
    REQUIRE(saved.size() == 1);
    CHECK(saved[0].file == folder / "fold.clothrec");
    CHECK_FALSE(saved[0].replace);
    std::ofstream(folder / "fold.clothrec") << "precious";
    CHECK(save(false).empty());
    saved = save(true);
    REQUIRE(saved.size() == 1);
    CHECK(saved[0].replace);
}

TEST_CASE("The File menu has the recordings and the meshes") {
    PanelDriver driver;
    show_made_up_timeline(driver.lab);
    driver.settle();
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        user->MenuClick("//##MainMenuBar/File/" ICON_FA_FOLDER_OPEN "  Open recording ...");
        user->Yield(2);
        user->SetRef("//$FOCUSED");
        user->ItemInputValue("##path", "some/fold.clothrec");
    }));
    REQUIRE(driver.asked<ui::OpenScene>().size() == 1);
    CHECK(driver.asked<ui::OpenScene>()[0].file == "some/fold.clothrec");
}

TEST_CASE("Meshes are exported from the loop or the whole line, in either format, every so many frames") {
    PanelDriver driver;
    show_made_up_timeline(driver.lab);
    driver.lab.file = "scenes/fold.json";
    driver.lab.timeline.loop = timeline::FrameRange{900, 1400};
    driver.lab.timeline_view.files.exporting = true;
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        user->Yield(2);
        user->SetRef("//$FOCUSED");
        user->ItemClick("PLY");
        user->ItemClick("###loop");
        user->ItemInputValue("Every so many frames", 5);
        user->ItemClick("###done");
    }));
    auto exported = driver.asked<ui::ExportMeshes>();
    REQUIRE(exported.size() == 1);
    CHECK(exported[0].folder == "fold-meshes");
    CHECK(exported[0].format == timeline::MeshFormat::ply);
    CHECK(exported[0].frames.first == 900);
    CHECK(exported[0].frames.last == 1400);
    CHECK(exported[0].every == 5);
    driver.lab.timeline.loop.reset();
    driver.lab.timeline_view.files.exporting = true;
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        user->Yield(2);
        user->ItemClick("//$FOCUSED/###done");
    }));
    exported = driver.asked<ui::ExportMeshes>();
    REQUIRE(exported.size() == 1);
    CHECK(exported[0].frames.first == 0);
    CHECK(exported[0].frames.last == made_up_frames);
}

TEST_CASE("What is being written is shown and can be cancelled") {
    PanelDriver driver;
    show_made_up_timeline(driver.lab);
    driver.lab.timeline.job = ui::TimelineWork::Job{"Saving fold.clothrec", 0.4};
    driver.settle();
    REQUIRE(driver.act([](ImGuiTestContext* user) { user->ItemClick("###job/Cancel"); }));
    CHECK(driver.asked<ui::CancelSaving>().size() == 1);
}

} // namespace clothlab::test
