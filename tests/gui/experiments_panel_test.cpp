// The Experiments panel: what it asks for, and, in the whole lab, what becomes of that.
#include <imgui.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>

#include "app/gui/chart_picture.h"
#include "lab_driver.h"
#include "panel_driver.h"
#include "small_scene.h"
#include "support/files.h"
#include "ui/charts.h"

namespace clothlab::test {
namespace {

namespace fs = std::filesystem;
using ui::ExperimentKind;

ui::FoundOut made_up(const scene::Scene& scene) {
    ui::FoundOut found;
    experiments::Findings& f = found.findings;
    f.title = "Made up";
    f.table.columns = {{"ks_n_m", "Stiffness (N/m)"}, {"error_mm", "Error (mm)"}};
    f.table.rows = {{1000.0, 4.0}, {4000.0, 2.0}, {16000.0, 1.0}};
    f.settings = {{"cloth.ks=1000"}, {"cloth.ks=4000"}, {"cloth.ks=16000"}};
    f.seconds = 0.1;
    f.charts = {{.title = "Error",
                 .x = {"Stiffness (N/m)", true},
                 .y = {"Error (mm)", true},
                 .series = {{.name = "error", .x = {1000, 4000, 16000}, .y = {4, 2, 1}, .rows = {0, 1, 2}}}}};
    f.sentences = {"Stiffer is more accurate."};
    found.scene = scene;
    found.command = "clothlab experiment sweep sweep-scene.json";
    return found;
}

void open(ui::Lab& lab, ExperimentKind kind) {
    lab.open[static_cast<std::size_t>(ui::PanelId::experiments)] = true;
    lab.experiments.wanted = kind;
}

std::vector<ui::ExperimentRequest> requests_of(const PanelDriver& driver) {
    return driver.asked<ui::ExperimentRequest>();
}

/// In the row's first column: rows are wider than the panel.
void click_row(ImGuiTestContext* user, const char* row) {
    user->SetRef("###Experiments");
    const ImVec2 corner = user->ItemInfo(row).RectFull.Min;
    user->MouseMoveToPos({corner.x + 8, corner.y + 8});
    user->MouseClick();
}

bool click(PanelDriver& driver, const char* item) {
    return driver.act([item](ImGuiTestContext* user) {
        user->SetRef("###Experiments");
        user->ItemClick(item);
    });
}

} // namespace

TEST_CASE("Every experiment can be opened from its menu and run, with the command that makes the same") {
    PanelDriver driver;
    const char* const titles[] = {"Accuracy", "Stability map", "What it needs", "Sweep"};
    const char* const commands[] = {"clothlab experiment accuracy accuracy-scene.json --seconds 0.5",
                                    "clothlab experiment stability stability-scene.json -x simulation.substeps=8:64 -y "
                                    "cloth.ks=10000:1e+06log",
                                    "clothlab experiment needs needs-scene.json --seconds 0.5",
                                    "clothlab experiment sweep sweep-scene.json --vary cloth.ks=500:50000:5log --vary "
                                    "cloth.density=50:450:3"};
    for (std::size_t i = 0; i < ui::experiment_kinds; ++i) {
        REQUIRE(driver.act([&](ImGuiTestContext* user) {
            user->SetRef("##MainMenuBar");
            user->MenuClick((std::string("Experiments/") + titles[i]).c_str());
        }));
        CHECK(driver.report(ui::PanelId::experiments).drawn);
        REQUIRE(click(driver, "**/###run"));
        const auto asked = requests_of(driver);
        REQUIRE(asked.size() == 1);
        const auto& run = std::get<ui::RunExperiment>(asked.front());
        CHECK(run.kind == static_cast<ExperimentKind>(i));
        CHECK(run.command.find(commands[i]) == 0);
        CHECK(run.work);
    }
}

TEST_CASE("While an experiment is under way it can be cancelled, and no other one can be begun") {
    PanelDriver driver;
    open(driver.lab, ExperimentKind::needs);
    driver.lab.experiments.job = ui::ExperimentWork::Job{ExperimentKind::needs, 0.4, "timing", 12};
    driver.settle();
    click(driver, "**/###run");
    CHECK(requests_of(driver).empty());
    REQUIRE(click(driver, "**/###cancel"));
    const auto asked = requests_of(driver);
    REQUIRE(asked.size() == 1);
    CHECK(std::holds_alternative<ui::CancelExperiment>(asked.front()));
}

TEST_CASE("A cell of a map and a row of the table are clicked to see that run") {
    PanelDriver driver;
    open(driver.lab, ExperimentKind::sweep);
    ui::FoundOut found = made_up(driver.lab.scene);
    experiments::Chart& map = found.findings.charts.front();
    map = {.title = "Map", .x = {"Stiffness (N/m)"}, .y = {"Substeps"}};
    map.cell_kinds = {{"stable", {0.3f, 0.6f, 0.4f}}, {"diverged", {0.8f, 0.3f, 0.3f}}};
    map.cells = {{0, 1, 0, 1, 0, 0}, {1, 2, 0, 1, 1, 2}};
    driver.lab.experiments.found[3] = std::make_shared<const ui::FoundOut>(std::move(found));
    driver.settle();
    // The chart has the right half of the panel: well inside its left and its right cell.
    const ui::PanelReport panel = driver.report(ui::PanelId::experiments);
    for (const auto& [share, row] : {std::pair{0.55f, 0u}, {0.78f, 2u}}) {
        REQUIRE(driver.act([&, share = share](ImGuiTestContext* user) {
            user->MouseMoveToPos({panel.x + share * panel.width, panel.y + 0.65f * panel.height});
            user->MouseClick();
        }));
        const auto asked = requests_of(driver);
        REQUIRE(asked.size() == 1);
        CHECK(std::get<ui::ShowTrial>(asked.front()).kind == ExperimentKind::sweep);
        CHECK(std::get<ui::ShowTrial>(asked.front()).row == row);
        CHECK(driver.lab.experiments.marked[3] == row);
    }
    driver.lab.experiments.chart[3] = 1; // the table
    driver.settle();
    REQUIRE(driver.act([](ImGuiTestContext* user) { click_row(user, "**/$$1/###row"); }));
    REQUIRE(requests_of(driver).size() == 1);
    CHECK(std::get<ui::ShowTrial>(requests_of(driver).front()).row == 1);
}

TEST_CASE("A chart is seen whole: its limits hold every point and line, a map's its cells") {
    experiments::Chart chart = made_up({}).findings.charts.front();
    chart.guides = {{"real time", true, 64000}, {"tolerance", false, 0.125}};
    const ui::ChartLimits limits = ui::limits_of(chart);
    CHECK(limits.x_low < 1000);
    CHECK(limits.x_high > 64000);
    CHECK(limits.y_low < 0.125);
    CHECK(limits.y_high > 4);
    CHECK(limits.y_low > 0.05);    // no more than a margin
    chart.series.front().y[1] = 0; // has no place on a logarithmic axis
    chart.series.front().x[2] = NAN;
    CHECK(ui::limits_of(chart).y_low > 0);
    chart.cells = {{10, 20, 1, 2, 0}};
    CHECK(ui::limits_of(chart).x_low == 10);
    CHECK(ui::limits_of(chart).y_high == 2);
    CHECK(ui::limits_of({.title = "", .x = {"", true}, .y = {}}).x_low > 0);
}

TEST_CASE("A chart becomes a picture of its own, whatever ImGui is in use") {
    PanelDriver driver;
    ImGuiContext* before = ImGui::GetCurrentContext();
    const render::Image picture = app::chart_picture(made_up({}).findings.charts.front(), 400, 300);
    CHECK(ImGui::GetCurrentContext() == before);
    CHECK(picture.width == 400);
    CHECK(picture.height == 300);
    const render::Image other = app::chart_picture(made_up({}).findings.charts.front(), 400, 300);
    CHECK(picture == other);
    experiments::Chart without = made_up({}).findings.charts.front();
    without.series.clear();
    CHECK(app::chart_picture(without, 400, 300) != picture);
    driver.settle(); // and the panels go on
}

// --- the whole lab ---------------------------------------------------------------------------------------------------

namespace {

/// A lab with a small scene and the Experiments panel open.
class ExperimentLab {
public:
    explicit ExperimentLab(ExperimentKind kind) : driver(small_scene(folder).string(), LabDriver::options(1440, 900)) {
        open(driver.lab(), kind);
        driver.settle();
    }
    ui::Lab& lab() { return driver.lab(); }
    bool click(const char* item) {
        return driver.act([item](ImGuiTestContext* user) {
            user->SetRef("###Experiments");
            user->ItemClick(item);
        });
    }
    template <class Condition>
    void wait_for(Condition condition) {
        while (!condition())
            driver.frame();
    }

    TemporaryFolder folder;
    LabDriver driver;
};

} // namespace

TEST_CASE("A sweep from the panel: found, a run of it beside its reference, and all of it written up", "[threads]") {
    ExperimentLab e(ExperimentKind::sweep);
    ui::SweepForm& form = e.lab().experiments.forms.sweep;
    form.first = {"cloth.ks", 500, 5000, 2, true, {}};
    form.two = false;
    form.frames = 4;
    REQUIRE(e.click("**/###run"));
    auto& found = e.lab().experiments.found[3];
    e.wait_for([&] { return found != nullptr; });
    REQUIRE(found->findings.table.rows.size() == 2);
    CHECK_FALSE(e.lab().experiments.job);

    e.lab().experiments.chart[3] = static_cast<int>(found->findings.charts.size());
    e.driver.settle();
    REQUIRE(e.driver.act([](ImGuiTestContext* user) { click_row(user, "**/$$0/###row"); }));
    e.wait_for([&] { return e.lab().experiments.showing.empty() && e.lab().timeline.ghost != 0; });
    CHECK(e.lab().scene.simulation.cloth.ks == 500);
    CHECK(e.lab().playing);
    e.driver.app().simulation().play(false);
    e.driver.settle();
    CHECK(e.lab().timeline.ghost_snapshot);

    const fs::path report = e.folder / "report";
    e.lab().ask(ui::ExperimentRequest(ui::WriteReport{report}));
    e.wait_for([&] { return fs::exists(report / "session.clothrec") && !e.lab().timeline.job; });
    const std::string page = read_file(report / "report.html");
    for (const char* file : {"viewport.png", "curves.png", "curves-2.png", "curves-3.png", "sweep.png", "sweep.csv"}) {
        INFO(file);
        CHECK(page.find(file) != std::string::npos);
        CHECK(fs::file_size(report / file) > 0);
    }
    CHECK(page.find("clothlab experiment sweep sweep-scene.json --vary cloth.ks=500:5000:2log") != std::string::npos);
    CHECK(fs::exists(report / "sweep-scene.json"));
    CHECK(read_file(report / "report.md").find("session.clothrec --frames 0 --hash") != std::string::npos);
    // Not over another one without being told to.
    e.lab().messages.clear();
    e.lab().ask(ui::ExperimentRequest(ui::WriteReport{report}));
    e.driver.settle();
    const auto refused = [](const ui::Message& m) { return m.error && m.text.find("exists already") != m.text.npos; };
    CHECK(std::any_of(e.lab().messages.begin(), e.lab().messages.end(), refused));
}

TEST_CASE("A time that is too long to be simulated is refused in the panel, and the lab goes on", "[threads]") {
    ExperimentLab e(ExperimentKind::needs);
    e.lab().experiments.forms.needs.seconds = 1e300;
    REQUIRE(e.click("**/###run"));
    const std::string& refused = e.lab().experiments.refused[2];
    e.wait_for([&] { return !refused.empty(); });
    CHECK(refused.find("too long a run") != std::string::npos);
}

TEST_CASE("The Experiments panel is drawn in a window of any size") {
    for (const auto& [width, height] : {std::pair{1, 1}, {40, 30}, {300, 90}, {2560, 200}}) {
        PanelDriver driver(width, height);
        driver.lab.experiments.found[3] = std::make_shared<const ui::FoundOut>(made_up(driver.lab.scene));
        for (std::size_t kind = 0; kind < ui::experiment_kinds; ++kind) {
            open(driver.lab, static_cast<ExperimentKind>(kind));
            driver.settle();
        }
        const render::Image picture = driver.picture();
        CHECK(picture.width == width);
    }
}

TEST_CASE("An experiment that cannot be made says why, and one that is cancelled leaves nothing", "[threads]") {
    ExperimentLab e(ExperimentKind::sweep);
    e.lab().experiments.forms.sweep.first = {"cloth.ks", 500, 500, 3, true, {}};
    REQUIRE(e.click("**/###run"));
    const std::string& refused = e.lab().experiments.refused[3];
    e.wait_for([&] { return !refused.empty(); });
    CHECK(refused.find("cloth.ks=500:500:3log") != std::string::npos);

    e.lab().experiments.forms.sweep.first = {"cloth.ks", 500, 5000, 20, true, {}};
    e.lab().experiments.forms.sweep.frames = 100000;
    REQUIRE(e.click("**/###run"));
    e.wait_for([&] { return e.lab().experiments.job.has_value(); });
    CHECK(refused.empty());
    REQUIRE(e.click("**/###cancel"));
    e.wait_for([&] { return !e.lab().experiments.job; });
    CHECK_FALSE(e.lab().experiments.found[3]);
}

// Not run by default: `clothlab_gui_tests "[draw-experiments]"` draws the picture of docs/experiments.md.
TEST_CASE("Draw the Experiments panel's picture", "[.][draw-experiments]") {
    LabDriver driver("two-pins", LabDriver::options(1440, 900));
    open(driver.lab(), ExperimentKind::stability);
    driver.settle();
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        user->SetRef("###Experiments");
        user->ItemClick("**/###run");
    }));
    const auto& found = driver.lab().experiments.found[1];
    while (!found)
        driver.frame();
    driver.settle();
    driver.lab().ask(ui::ExperimentRequest(ui::ShowTrial{ExperimentKind::stability, 0}));
    driver.lab().experiments.marked[1] = 0;
    driver.settle();
    driver.app().simulation().play(false);
    driver.app().simulation().step_frames(30);
    driver.settle();
    render::write_png(driver.app().picture(), checkout() / "docs/pictures/experiments.png");
}

} // namespace clothlab::test
