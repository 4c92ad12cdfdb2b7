#include "experiments/report.h"

#include <catch2/catch_test_macros.hpp>

#include "experiments/page.h"

using namespace clothlab::experiments;

namespace {

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

Findings made_up() {
    Findings findings;
    findings.title = "Accuracy of <two pins>";
    findings.table.columns = {{"method", "Method"}, {"error_mm", "Error (mm)"}};
    findings.table.rows = {{"rk4", 0.5}, {"heun & others", 2.0}};
    findings.settings = {{"simulation.integrator=rk4"}, {"simulation.integrator=heun"}};
    findings.charts = {{.title = "Error", .x = {}, .y = {}}, {.title = "Cost", .x = {}, .y = {}}};
    findings.sentences = {"The cheapest is *rk4*."};
    findings.notes = {"Timed by turns."};
    return findings;
}

} // namespace

TEST_CASE("A report has what was found, where its files are, and the command to get it again") {
    const Report report{"A & B", {section_of(made_up(), "accuracy", "clothlab experiment accuracy 'a b.json'")}};
    const std::string html = to_html(report);
    CHECK(contains(html, "<title>A &amp; B</title>"));
    CHECK(contains(html, "<h2>Accuracy of &lt;two pins&gt;</h2>"));
    CHECK(contains(html, "<p>The cheapest is *rk4*.</p>"));
    CHECK(contains(html, "src=\"accuracy.png\""));
    CHECK(contains(html, "src=\"accuracy-2.png\""));
    CHECK(contains(html, "<td>heun &amp; others</td><td class=\"number\">2</td>"));
    CHECK(contains(html, "href=\"accuracy.csv\""));
    CHECK(contains(html, "clothlab experiment accuracy 'a b.json'"));
    const std::string markdown = to_markdown(report);
    CHECK(contains(markdown, "# A & B\n"));
    CHECK(contains(markdown, "## Accuracy of \\<two pins\\>\n"));
    CHECK(contains(markdown, "The cheapest is \\*rk4\\*."));
    CHECK(contains(markdown, "![Cost](<accuracy-2.png>)"));
    CHECK(contains(markdown, "| rk4 | 0.5 |"));
    CHECK(contains(markdown, "```sh\nclothlab experiment accuracy 'a b.json'\n```"));
}

TEST_CASE("A page shows the first rows of a long table and says that there are more") {
    Findings findings = made_up();
    for (std::size_t i = 0; i < most_rows_shown; ++i)
        findings.table.rows.push_back({"another", static_cast<double>(i)});
    const std::string html = to_html({"Long", {section_of(findings, "sweep", "")}});
    CHECK(contains(html, "The first 200 of 202 rows."));
    CHECK(contains(html, ">197<"));
    CHECK_FALSE(contains(html, ">198<"));
}

TEST_CASE("Charts of one experiment have files of their own") {
    CHECK(chart_file("a.b/c.png", 0) == "a.b/c.png");
    CHECK(chart_file("a.b/c.png", 2) == "a.b/c-3.png");
    CHECK(chart_file("a.b/c", 1) == "a.b/c-2");
}

TEST_CASE("A word for the shell is quoted where the shell would read it otherwise") {
    CHECK(shell_word("cloth.ks=1e4:1e6log") == "cloth.ks=1e4:1e6log");
    CHECK(shell_word("two words") == "'two words'");
    CHECK(shell_word("it's") == "'it'\\''s'");
    CHECK(shell_word("") == "''");
}
