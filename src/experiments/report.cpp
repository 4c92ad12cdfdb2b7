#include "experiments/report.h"

#include <algorithm>
#include <cstdio>

#include "experiments/page.h"
#include "scene/fields.h"

namespace clothlab::experiments {
namespace {

constexpr const char* style = R"(figure { margin: 1rem 0; max-width: 60rem; }
figcaption { font-size: 0.9rem; color: var(--faint); margin-top: 0.4rem; }
.table { overflow-x: auto; margin: 1rem 0; }
table { border-collapse: collapse; font-size: 0.9rem; font-variant-numeric: tabular-nums; }
th, td { padding: 0.25rem 0.7rem; border-bottom: 1px solid var(--line); text-align: left; }
td.number, th.number { text-align: right; }
li { max-width: 46rem; color: var(--faint); font-size: 0.9rem; }
)";

bool is_text(const Table& table, std::size_t column) {
    return std::any_of(table.rows.begin(), table.rows.end(),
                       [column](const auto& row) { return std::holds_alternative<std::string>(row[column]); });
}

std::string html_of(const Table& table) {
    const auto cell = [&](const char* tag, std::size_t column, const std::string& text) {
        return "<" + std::string(tag) + (is_text(table, column) ? ">" : " class=\"number\">") + html_escaped(text) +
               "</" + tag + ">";
    };
    std::string html = "<div class=\"table\"><table>\n<tr>";
    for (std::size_t i = 0; i < table.columns.size(); ++i)
        html += cell("th", i, table.columns[i].title);
    html += "</tr>\n";
    for (const auto& row : table.rows) {
        html += "<tr>";
        for (std::size_t i = 0; i < row.size(); ++i)
            html += cell("td", i, shown(row[i], table.columns[i]));
        html += "</tr>\n";
    }
    return html + "</table></div>\n";
}

/// What of a table a page shows, and a sentence on what it does not.
std::pair<Table, std::string> shown_part(const ReportSection& section) {
    Table table = *section.table;
    const std::size_t rows = table.rows.size();
    if (rows <= most_rows_shown)
        return {std::move(table), ""};
    table.rows.resize(most_rows_shown);
    return {std::move(table),
            "The first " + std::to_string(most_rows_shown) + " of " + std::to_string(rows) + " rows."};
}

std::string html_of(const ReportSection& section) {
    std::string html = "<section>\n<h2>" + html_escaped(section.title) + "</h2>\n";
    for (const std::string& paragraph : section.paragraphs)
        html += "<p>" + html_escaped(paragraph) + "</p>\n";
    for (const ReportPicture& picture : section.pictures) {
        const std::string file = html_escaped(picture.file);
        html += "<figure><a href=\"" + file + "\"><img src=\"" + file + "\" loading=\"lazy\" alt=\"" +
                html_escaped(picture.caption) + "\"></a><figcaption>" + html_escaped(picture.caption) +
                "</figcaption></figure>\n";
    }
    if (section.table) {
        const auto [table, rest] = shown_part(section);
        html += html_of(table);
        if (!section.table_file.empty())
            html += "<p>" + (rest.empty() ? "" : rest + " ") + "The same numbers: <a href=\"" +
                    html_escaped(section.table_file) + "\">" + html_escaped(section.table_file) + "</a></p>\n";
    }
    if (!section.notes.empty()) {
        html += "<ul>\n";
        for (const std::string& note : section.notes)
            html += "<li>" + html_escaped(note) + "</li>\n";
        html += "</ul>\n";
    }
    if (!section.commands.empty()) {
        html += "<pre><code>";
        for (const std::string& command : section.commands)
            html += html_escaped(command) + "\n";
        html += "</code></pre>\n";
    }
    return html + "</section>\n";
}

/// Text in which nothing is markup.
std::string plain(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (std::string_view("\\`*_[]<>#|").find(c) != std::string_view::npos)
            result += '\\';
        result += c == '\n' ? ' ' : c;
    }
    return result;
}

std::string value_of(const scene::Field& field, const scene::Scene& scene) {
    char text[96];
    switch (field.type) {
    case scene::FieldType::boolean:
        return field.get(scene) != 0 ? "on" : "off";
    case scene::FieldType::choice:
        return std::string(field.choices[static_cast<std::size_t>(field.get(scene))]);
    case scene::FieldType::vector: {
        const sim::Vec3 v = field.get_vector(scene);
        std::snprintf(text, sizeof text, "%.6g, %.6g, %.6g", v.x, v.y, v.z);
        return text;
    }
    case scene::FieldType::text:
        return field.get_text(scene);
    default:
        std::snprintf(text, sizeof text, "%.9g", field.get(scene) * field.shown.factor);
        return text;
    }
}

std::string markdown_of(const ReportSection& section) {
    std::string text = "## " + plain(section.title) + "\n\n";
    for (const std::string& paragraph : section.paragraphs)
        text += plain(paragraph) + "\n\n";
    for (const ReportPicture& picture : section.pictures)
        text += "![" + plain(picture.caption) + "](<" + picture.file + ">)\n\n";
    if (section.table) {
        const auto [table, rest] = shown_part(section);
        text += to_markdown(table) + "\n";
        if (!section.table_file.empty())
            text += (rest.empty() ? "" : rest + " ") + "The same numbers: [" + plain(section.table_file) + "](<" +
                    section.table_file + ">)\n\n";
    }
    for (const std::string& note : section.notes)
        text += "- " + plain(note) + "\n";
    text += section.notes.empty() ? "" : "\n";
    if (!section.commands.empty()) {
        text += "```sh\n";
        for (const std::string& command : section.commands)
            text += command + "\n";
        text += "```\n\n";
    }
    return text;
}

} // namespace

std::string to_html(const Report& report) {
    std::string html = page_head(report.title, style);
    for (const ReportSection& section : report.sections)
        html += html_of(section);
    return html + "</body>\n</html>\n";
}

std::string to_markdown(const Report& report) {
    std::string text = "# " + plain(report.title) + "\n\n";
    for (const ReportSection& section : report.sections)
        text += markdown_of(section);
    while (text.ends_with("\n\n"))
        text.pop_back();
    return text;
}

ReportSection section_of(const Findings& findings, const std::string& name, const std::string& command) {
    ReportSection section;
    section.title = findings.title;
    section.paragraphs = findings.sentences;
    for (std::size_t i = 0; i < findings.charts.size(); ++i)
        section.pictures.push_back({chart_file(name + ".png", i), findings.charts[i].title});
    section.table = findings.table;
    section.table_file = name + ".csv";
    section.notes = findings.notes;
    if (!command.empty())
        section.commands.push_back(command);
    return section;
}

ReportSection parameter_section(const scene::Scene& scene, const scene::Scene& loaded) {
    ReportSection section{.title = "Parameters"};
    Table table;
    table.columns = {{"key", "Key"}, {"parameter", "Parameter"}, {"value", "Value"}, {"unit", "Unit"}};
    if (!(scene.simulation == loaded.simulation))
        table.columns.push_back({"loaded", "As loaded, where it was another"});
    for (const scene::Field& field : scene::fields()) {
        if (field.effect == scene::Effect::look)
            continue;
        const std::string now = value_of(field, scene), before = value_of(field, loaded);
        table.rows.push_back({std::string(field.key), std::string(field.label), now, std::string(field.shown.unit)});
        if (table.columns.size() > 4)
            table.rows.back().push_back(now == before ? Value() : Value(before));
    }
    section.table = std::move(table);
    section.notes = {"scene.json has all of them, with colliders, pins, camera and look."};
    return section;
}

std::string program_version() {
#ifdef __clang__
    constexpr const char* compiler = "Clang ";
#else
    constexpr const char* compiler = "GCC ";
#endif
    return std::string("clothlab " CLOTHLAB_VERSION ", compiled by ") + compiler + __VERSION__;
}

std::string chart_file(const std::string& png, std::size_t index) {
    const std::size_t dot = png.rfind('.'), slash = png.rfind('/');
    const bool has_ending = dot != std::string::npos && (slash == std::string::npos || dot > slash);
    const std::size_t end = has_ending ? dot : png.size();
    return index == 0 ? png : png.substr(0, end) + "-" + std::to_string(index + 1) + png.substr(end);
}

} // namespace clothlab::experiments
