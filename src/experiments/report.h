// A write-up: what was simulated, measured and seen, how to get it again, as one HTML page and as Markdown. Pictures
// and tables lie in files beside it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/findings.h"
#include "scene/scene.h"

namespace clothlab::experiments {

struct ReportPicture {
    std::string file; ///< relative to the report
    std::string caption;
};

struct ReportSection {
    std::string title;
    std::vector<std::string> paragraphs = {};
    std::vector<ReportPicture> pictures = {};
    std::optional<Table> table = {};
    std::string table_file = {}; ///< the same as CSV, relative to the report; empty: none
    std::vector<std::string> notes = {};
    std::vector<std::string> commands = {}; ///< that make what the section shows, to be run in the report's folder
};

struct Report {
    std::string title;
    std::vector<ReportSection> sections;
};

/// The page; needs nothing but the pictures beside it.
std::string to_html(const Report& report);
std::string to_markdown(const Report& report);

/// No more rows of a table are shown on a page; its CSV file has all of them.
inline constexpr std::size_t most_rows_shown = 200;

/// The section of an experiment, without its files: those are named NAME.csv, NAME.png, NAME-2.png, ...
ReportSection section_of(const Findings& findings, const std::string& name, const std::string& command);

/// All parameters of a simulation, with those of the scene as it was loaded where they differ.
ReportSection parameter_section(const scene::Scene& scene, const scene::Scene& loaded);

/// "clothlab 0.1.0, compiled by GCC 12.2.0".
std::string program_version();

/// NAME.png, NAME-2.png, ...: the file of a chart of several.
std::string chart_file(const std::string& png, std::size_t index);

} // namespace clothlab::experiments
