#include "cli/gui/gallery_page.h"

#include <algorithm>

namespace clothlab::cli {
namespace {

constexpr const char* head = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>clothlab gallery</title>
<style>
:root { color-scheme: light dark; --page: #fbfbfa; --text: #1c1f23; --faint: #5d656e; --line: #dcdfe3; --code: #eef0f2;
  --trouble: #9a3412; --link: #0b5cad; }
@media (prefers-color-scheme: dark) {
  :root { --page: #16181c; --text: #e4e7eb; --faint: #9aa4af; --line: #2d3239; --code: #22262c;
    --trouble: #f5a97f; --link: #7fb6f0; } }
body { margin: 0 auto; max-width: 90rem; padding: 1.5rem clamp(1rem, 4vw, 3rem) 4rem; background: var(--page);
  color: var(--text); font: 1rem/1.55 system-ui, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif; }
h1 { font-size: 2rem; line-height: 1.2; margin: 1rem 0 0.5rem; }
h2 { font-size: 1.4rem; line-height: 1.3; margin: 3.5rem 0 0.25rem; padding-top: 1rem; border-top: 1px solid var(--line); }
p { max-width: 46rem; margin: 0.5rem 0 1rem; }
a { color: var(--link); }
nav ul { columns: 15rem; padding-left: 1.2rem; }
.figures { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 24rem), 1fr)); gap: 2rem 1.5rem; }
figure { margin: 0; min-width: 0; }
img { display: block; width: 100%; height: auto; border-radius: 4px; }
figcaption { font-size: 0.9rem; line-height: 1.45; margin-top: 0.5rem; }
figcaption b { font-size: 1rem; }
figcaption span { display: block; margin-top: 0.2rem; color: var(--faint); }
figcaption .trouble { color: var(--trouble); }
details { margin-top: 0.3rem; }
summary { cursor: pointer; color: var(--faint); }
pre { margin: 0.3rem 0 0; padding: 0.6rem 0.75rem; border-radius: 4px; background: var(--code); font-size: 0.8rem;
  white-space: pre-wrap; overflow-wrap: anywhere; }
code { font-family: ui-monospace, "SF Mono", Consolas, monospace; }
</style>
</head>
<body>
<h1>clothlab gallery</h1>
)";

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text)
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        default:
            result += c;
        }
    return result;
}

/// A word for the shell: as it is where it has only letters that mean nothing to it.
std::string shell_word(const std::string& word) {
    const auto plain = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               std::string_view("_-+=./:,@%").find(c) != std::string_view::npos;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), plain))
        return word;
    std::string quoted = "'";
    for (const char c : word)
        quoted += c == '\'' ? "'\\''" : std::string(1, c);
    return quoted + "'";
}

std::string anchor(std::size_t section) {
    return "section-" + std::to_string(section + 1);
}

} // namespace

std::string figure_command(const Section& section, const Figure& figure, int width, int height) {
    std::string command = "clothlab render " + shell_word(figure.scene) + " --frame " + std::to_string(figure.frame) +
                          " --size " + std::to_string(width) + "x" + std::to_string(height);
    for (const auto* settings : {&section.settings, &figure.settings})
        for (const std::string& setting : *settings)
            command += " --set " + shell_word(setting);
    return command + " -o " + shell_word(figure.name + ".png");
}

std::string figure_html(const Section& section, const Figure& figure, const FigureResult& result, int width,
                        int height) {
    std::string html = "<figure id=\"" + escaped(figure.name) + "\">\n";
    const std::string file = escaped(figure.name) + ".png";
    const Caption& c = result.caption;
    if (result.drawn)
        html += "<a href=\"" + file + "\"><img src=\"" + file + "\" width=\"" + std::to_string(result.width) +
                "\" height=\"" + std::to_string(result.height) + "\" loading=\"lazy\" alt=\"" +
                escaped(section.title + ": " + figure.title + ". " + c.parameters + ". " + c.outcome) + "\"></a>\n";
    html += "<figcaption><b>" + escaped(figure.title) + "</b>\n";
    if (result.drawn)
        html += "<span>" + escaped(c.parameters) + ".</span>\n<span>" + escaped(c.look) + ".</span>\n<span" +
                (c.trouble ? " class=\"trouble\"" : "") + ">" + escaped(c.outcome) + "</span>\n";
    else
        html += "<span class=\"trouble\">This figure could not be drawn: " + escaped(result.error) + "</span>\n";
    html += "<details><summary>The command that draws it</summary><pre><code>" +
            escaped(figure_command(section, figure, width, height)) + "</code></pre></details>\n";
    return html + "</figcaption>\n</figure>\n";
}

std::optional<std::string> figure_of_page(const std::string& page, const std::string& name) {
    const std::size_t begin = page.find("<figure id=\"" + escaped(name) + "\">");
    constexpr std::string_view end_tag = "</figure>\n";
    const std::size_t end = begin == std::string::npos ? begin : page.find(end_tag, begin);
    if (end == std::string::npos)
        return std::nullopt;
    std::string html = page.substr(begin, end + end_tag.size() - begin);
    return html.find("<img ") == std::string::npos ? std::nullopt : std::optional(std::move(html));
}

std::string gallery_page(const std::vector<Section>& sections, const std::vector<std::string>& figures) {
    std::string contents, body;
    std::size_t figure = 0, shown = 0;
    for (std::size_t s = 0; s < sections.size(); ++s) {
        std::string section;
        for (std::size_t i = 0; i < sections[s].figures.size(); ++i, ++figure) {
            section += figures[figure];
            shown += figures[figure].empty() ? 0 : 1;
        }
        if (section.empty())
            continue;
        contents += "<li><a href=\"#" + anchor(s) + "\">" + escaped(sections[s].title) + "</a></li>\n";
        body += "<section>\n<h2 id=\"" + anchor(s) + "\">" + escaped(sections[s].title) + "</h2>\n<p>" +
                escaped(sections[s].text) + "</p>\n<div class=\"figures\">\n" + section + "</div>\n</section>\n";
    }
    return head +
           ("<p>" + std::to_string(shown) +
            " figures of mass-spring cloth, simulated and drawn by <code>clothlab gallery</code>, clothlab " +
            escaped(CLOTHLAB_VERSION) +
            ". Below each picture: the parameters, what the run reported about itself at that moment (in colour where "
            "something went wrong, with the cause), and the command that draws the picture alone. <a "
            "href=\"overview.png\">All in one picture</a>.</p>\n<nav><ul>\n") +
           contents + "</ul></nav>\n" + body + "</body>\n</html>\n";
}

} // namespace clothlab::cli
