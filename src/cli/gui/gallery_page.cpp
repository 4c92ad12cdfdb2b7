#include "cli/gui/gallery_page.h"

#include "experiments/page.h"

namespace clothlab::cli {

using experiments::html_escaped;
using experiments::shell_word;

namespace {

constexpr const char* style = R"(nav ul { columns: 15rem; padding-left: 1.2rem; }
.figures { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 24rem), 1fr)); gap: 2rem 1.5rem; }
figure { margin: 0; min-width: 0; }
figcaption { font-size: 0.9rem; line-height: 1.45; margin-top: 0.5rem; }
figcaption b { font-size: 1rem; }
figcaption span { display: block; margin-top: 0.2rem; color: var(--faint); }
figcaption .trouble { color: var(--trouble); }
details { margin-top: 0.3rem; }
summary { cursor: pointer; color: var(--faint); }
)";

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
    std::string html = "<figure id=\"" + html_escaped(figure.name) + "\">\n";
    const std::string file = html_escaped(figure.name) + ".png";
    const Caption& c = result.caption;
    if (result.drawn)
        html += "<a href=\"" + file + "\"><img src=\"" + file + "\" width=\"" + std::to_string(result.width) +
                "\" height=\"" + std::to_string(result.height) + "\" loading=\"lazy\" alt=\"" +
                html_escaped(section.title + ": " + figure.title + ". " + c.parameters + ". " + c.outcome) +
                "\"></a>\n";
    html += "<figcaption><b>" + html_escaped(figure.title) + "</b>\n";
    if (result.drawn)
        html += "<span>" + html_escaped(c.parameters) + ".</span>\n<span>" + html_escaped(c.look) + ".</span>\n<span" +
                (c.trouble ? " class=\"trouble\"" : "") + ">" + html_escaped(c.outcome) + "</span>\n";
    else
        html += "<span class=\"trouble\">This figure could not be drawn: " + html_escaped(result.error) + "</span>\n";
    html += "<details><summary>The command that draws it</summary><pre><code>" +
            html_escaped(figure_command(section, figure, width, height)) + "</code></pre></details>\n";
    return html + "</figcaption>\n</figure>\n";
}

std::optional<std::string> figure_of_page(const std::string& page, const std::string& name) {
    const std::size_t begin = page.find("<figure id=\"" + html_escaped(name) + "\">");
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
        contents += "<li><a href=\"#" + anchor(s) + "\">" + html_escaped(sections[s].title) + "</a></li>\n";
        body += "<section>\n<h2 id=\"" + anchor(s) + "\">" + html_escaped(sections[s].title) + "</h2>\n<p>" +
                html_escaped(sections[s].text) + "</p>\n<div class=\"figures\">\n" + section + "</div>\n</section>\n";
    }
    return experiments::page_head("clothlab gallery", style) +
           ("<p>" + std::to_string(shown) +
            " figures of mass-spring cloth, simulated and drawn by <code>clothlab gallery</code>, clothlab " +
            html_escaped(CLOTHLAB_VERSION) +
            ". Below each picture: the parameters, what the run reported about itself at that moment (in colour where "
            "something went wrong, with the cause), and the command that draws the picture alone. <a "
            "href=\"overview.png\">All in one picture</a>.</p>\n<nav><ul>\n") +
           contents + "</ul></nav>\n" + body + "</body>\n</html>\n";
}

} // namespace clothlab::cli
