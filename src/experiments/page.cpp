#include "experiments/page.h"

#include <algorithm>

namespace clothlab::experiments {
namespace {

constexpr const char* common_style =
    R"(:root { color-scheme: light dark; --page: #fbfbfa; --text: #1c1f23; --faint: #5d656e; --line: #dcdfe3; --code: #eef0f2;
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
img { display: block; width: 100%; height: auto; border-radius: 4px; }
pre { margin: 0.3rem 0 0; padding: 0.6rem 0.75rem; border-radius: 4px; background: var(--code); font-size: 0.8rem;
  white-space: pre-wrap; overflow-wrap: anywhere; }
code { font-family: ui-monospace, "SF Mono", Consolas, monospace; }
)";

} // namespace

std::string html_escaped(std::string_view text) {
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

std::string page_head(const std::string& title, std::string_view style) {
    std::string head = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>)";
    head += html_escaped(title) + "</title>\n<style>\n" + common_style;
    head += style;
    return head + "</style>\n</head>\n<body>\n<h1>" + html_escaped(title) + "</h1>\n";
}

} // namespace clothlab::experiments
