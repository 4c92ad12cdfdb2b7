// Experiments: settings on the left, what was found on the right.
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "ui/charts.h"
#include "ui/experiment_rows.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, experiment_kinds> titles{"Accuracy", "Stability map", "What it needs", "Sweep"};
constexpr std::array<const char*, experiment_kinds> questions{
    "Every method's error against its cost: which one is good enough, and cheapest?",
    "Where does the method fail, and does that agree with the predicted limit?",
    "What may be left out of this scene's model before it shows?", "The scene for many values of its parameters."};
constexpr const char* save_window = "Save what was found###save findings";
constexpr const char* report_window = "Write a report###write report";

void draw_job(Lab& lab) {
    const ExperimentWork::Job& job = *lab.experiments.job;
    ImGui::Text("%s: %s", titles[static_cast<std::size_t>(job.kind)], job.what.c_str());
    char text[64];
    const double left = job.share > 0.02 ? job.elapsed_s * (1 - job.share) / job.share : -1;
    if (left >= 0)
        std::snprintf(text, sizeof text, "%.0f %%, %.0f s left", job.share * 100, left);
    else
        std::snprintf(text, sizeof text, "%.0f s", job.elapsed_s);
    ImGui::ProgressBar(static_cast<float>(job.share), {-ImGui::GetFontSize() * 6, 0}, text);
    ImGui::SameLine();
    if (ImGui::Button(ICON_FA_XMARK "  Cancel###cancel"))
        lab.ask(ExperimentRequest(CancelExperiment{}));
}

void show_trial(Lab& lab, ExperimentKind kind, std::size_t row) {
    lab.experiments.marked[static_cast<std::size_t>(kind)] = row;
    lab.ask(ExperimentRequest(ShowTrial{kind, row}));
}

void draw_table(Lab& lab, ExperimentKind kind, const experiments::Table& table) {
    const auto columns = static_cast<int>(table.columns.size());
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollX | ImGuiTableFlags_ScrollY |
                                      ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_BordersInnerV |
                                      ImGuiTableFlags_NoSavedSettings;
    if (columns == 0 || columns > 64 || !ImGui::BeginTable("rows", columns, flags, ImGui::GetContentRegionAvail()))
        return;
    ImGui::TableSetupScrollFreeze(1, 1);
    for (const experiments::Column& column : table.columns)
        ImGui::TableSetupColumn(column.title.c_str());
    ImGui::TableHeadersRow();
    const auto& marked = lab.experiments.marked[static_cast<std::size_t>(kind)];
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(table.rows.size()));
    while (clipper.Step())
        for (auto i = static_cast<std::size_t>(clipper.DisplayStart); i < static_cast<std::size_t>(clipper.DisplayEnd);
             ++i) {
            ImGui::TableNextRow();
            ImGui::PushID(static_cast<int>(i));
            for (std::size_t c = 0; c < table.columns.size(); ++c) {
                ImGui::TableNextColumn();
                const std::string text = shown(table.rows[i][c], table.columns[c]);
                if (c > 0)
                    ImGui::TextUnformatted(text.c_str());
                else if (ImGui::Selectable((text + "###row").c_str(), marked == i, ImGuiSelectableFlags_SpanAllColumns))
                    show_trial(lab, kind, i);
            }
            ImGui::PopID();
        }
    ImGui::EndTable();
}

/// One chart of several, or the table.
void choose_view(Lab& lab, std::size_t kind, const experiments::Findings& findings) {
    int& chosen = lab.experiments.chart[kind];
    const auto charts = static_cast<int>(findings.charts.size());
    chosen = std::clamp(chosen, 0, charts);
    const auto name = [&](int i) {
        return i == charts ? std::string("Table") : findings.charts[static_cast<std::size_t>(i)].title;
    };
    ImGui::SetNextItemWidth(-ImGui::GetFontSize() * 6);
    if (ImGui::BeginCombo("##view", name(chosen).c_str())) {
        for (int i = 0; i <= charts; ++i)
            if (ImGui::Selectable(name(i).c_str(), i == chosen))
                chosen = i;
        ImGui::EndCombo();
    }
    ImGui::SameLine();
    if (icon_button(ICON_FA_FLOPPY_DISK, "##save",
                    "Save the table as CSV, the charts as PNG pictures, or the run that was clicked as a scene")) {
        auto& files = lab.experiments.files;
        files.save = true;
        files.kind = static_cast<ExperimentKind>(kind);
        files.path = std::string(experiment_names[kind]) + ".csv";
    }
    ImGui::SameLine();
    const std::string help = std::string("Copy the command that makes the same, once the scene is saved as ") +
                             experiment_names[kind] + "-scene.json";
    if (icon_button(ICON_FA_COPY, "##command", help.c_str()))
        ImGui::SetClipboardText(lab.experiments.found[kind]->command.c_str());
}

void draw_findings(Lab& lab, ExperimentKind which) {
    const auto kind = static_cast<std::size_t>(which);
    const std::shared_ptr<const FoundOut> found = lab.experiments.found[kind];
    const std::string& refused = lab.experiments.refused[kind];
    if (!refused.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, colour::warning);
        ImGui::TextWrapped("%s", (std::string(ICON_FA_TRIANGLE_EXCLAMATION "  ") + refused).c_str());
        ImGui::PopStyleColor();
    }
    if (!found) {
        if (!refused.empty())
            return;
        ImGui::PushTextWrapPos(0);
        ImGui::TextColored(colour::faint, "%s", questions[kind]);
        ImGui::PopTextWrapPos();
        return;
    }
    const experiments::Findings& findings = found->findings;
    choose_view(lab, kind, findings);
    if (!lab.experiments.showing.empty()) {
        ImGui::TextColored(colour::warning, "%s", lab.experiments.showing.c_str());
    } else if (!(found->scene.simulation == lab.scene.simulation) && !lab.experiments.marked[kind]) {
        ImGui::TextColored(colour::faint, "Of another scene, or of other parameters: %s", findings.title.c_str());
    }
    ImGui::PushTextWrapPos(0);
    if (!findings.sentences.empty())
        ImGui::TextUnformatted(findings.sentences.front().c_str());
    ImGui::PopTextWrapPos();
    std::string more;
    for (std::size_t i = 1; i < findings.sentences.size(); ++i)
        more += findings.sentences[i] + "\n";
    for (const std::string& note : findings.notes)
        more += "- " + note + "\n";
    if (!more.empty())
        tooltip(more);
    const auto chart = static_cast<std::size_t>(lab.experiments.chart[kind]);
    if (chart >= findings.charts.size())
        return draw_table(lab, which, findings.table);
    // Another result is another plot, seen whole.
    ImGui::PushID(found.get());
    const ChartMouse mouse =
        draw_chart(findings.charts[chart], findings.table, ("chart" + std::to_string(chart)).c_str(),
                   ImGui::GetContentRegionAvail(), false, false, lab.experiments.marked[kind]);
    ImGui::PopID();
    if (mouse.clicked)
        show_trial(lab, which, *mouse.clicked);
}

void draw_tab(Lab& lab, ExperimentKind kind) {
    const float font = ImGui::GetFontSize();
    if (ImGui::BeginChild("settings", {font * 19, 0})) {
        const bool busy = lab.experiments.job.has_value();
        if (auto request = experiment_form(lab, kind, !busy))
            lab.ask(ExperimentRequest(std::move(*request)));
    }
    ImGui::EndChild();
    ImGui::SameLine();
    if (ImGui::BeginChild("findings", {0, 0})) {
        if (lab.experiments.job)
            draw_job(lab);
        draw_findings(lab, kind);
    }
    ImGui::EndChild();
}

bool begin_window(const char* window, bool& wanted) {
    if (wanted) {
        ImGui::OpenPopup(window);
        ImGui::SetNextWindowFocus();
    }
    wanted = false;
    ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, {0.5f, 0.5f});
    return ImGui::BeginPopupModal(window, nullptr, ImGuiWindowFlags_AlwaysAutoResize);
}

/// Rows of a window that asks for a path: what was typed is wanted, and whether it replaces something; none yet.
std::optional<bool> path_rows(std::string& path, const fs::path& replaced, const char* verb) {
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 30);
    if (ImGui::IsWindowAppearing())
        ImGui::SetKeyboardFocusHere();
    const bool entered = ImGui::InputText("##path", &path, ImGuiInputTextFlags_EnterReturnsTrue);
    std::error_code error;
    const bool replaces = !path.empty() && fs::exists(replaced, error);
    if (replaces)
        ImGui::TextColored(colour::warning, ICON_FA_TRIANGLE_EXCLAMATION "  This exists and would be replaced.");
    ImGui::BeginDisabled(path.empty());
    // Enter alone never replaces another file.
    const bool done =
        ImGui::Button(replaces ? "Replace###done" : (std::string(verb) + "###done").c_str()) || (entered && !replaces);
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGuiKey_Escape))
        ImGui::CloseCurrentPopup();
    if (!done || path.empty())
        return {};
    ImGui::CloseCurrentPopup();
    return replaces;
}

} // namespace

void draw_experiments(Lab& lab) {
    ExperimentWork& work = lab.experiments;
    if (!ImGui::BeginTabBar("experiments", ImGuiTabBarFlags_DrawSelectedOverline))
        return;
    for (std::size_t i = 0; i < experiment_kinds; ++i) {
        const auto kind = static_cast<ExperimentKind>(i);
        const ImGuiTabItemFlags flags = work.wanted == kind ? ImGuiTabItemFlags_SetSelected : ImGuiTabItemFlags_None;
        const bool seen = ImGui::BeginTabItem(titles[i], nullptr, flags);
        tooltip(questions[i]);
        if (!seen)
            continue;
        draw_tab(lab, kind);
        ImGui::EndTabItem();
    }
    work.wanted.reset();
    ImGui::EndTabBar();
}

void experiments_menu(Lab& lab) {
    for (std::size_t i = 0; i < experiment_kinds; ++i) {
        if (ImGui::MenuItem(titles[i])) {
            lab.experiments.wanted = static_cast<ExperimentKind>(i);
            lab.open[static_cast<std::size_t>(PanelId::experiments)] = true;
            ImGui::SetWindowFocus("###Experiments");
        }
        tooltip(questions[i]);
    }
}

void draw_experiment_windows(Lab& lab) {
    auto& files = lab.experiments.files;
    if (begin_window(save_window, files.save)) {
        ImGui::TextUnformatted(
            "Save as .csv, the table; as .png, the charts; or as .json, a scene with the\nparameters of "
            "the run that was clicked last:");
        if (const auto replace = path_rows(files.path, files.path, "Save"))
            lab.ask(ExperimentRequest(SaveFindings{files.kind, files.path, *replace,
                                                   lab.experiments.marked[static_cast<std::size_t>(files.kind)]}));
        ImGui::EndPopup();
    }
    if (files.report && files.folder.empty())
        files.folder = (lab.file.stem().empty() ? std::string("session") : lab.file.stem().string()) + "-report";
    if (begin_window(report_window, files.report)) {
        ImGui::TextUnformatted("A folder for report.html and report.md with pictures, curves, tables, parameters,\nthe "
                               "recording of the session and the commands to get it all again:");
        if (const auto replace = path_rows(files.folder, fs::path(files.folder) / "report.html", "Write"))
            lab.ask(ExperimentRequest(WriteReport{files.folder, *replace}));
        ImGui::EndPopup();
    }
}

} // namespace clothlab::ui
