// What pages and commands that clothlab writes are made of.
#pragma once

#include <string>
#include <string_view>

namespace clothlab::experiments {

/// Text as HTML has it, also between double quotes.
std::string html_escaped(std::string_view text);
/// A word for the shell: as it is where it has only letters that mean nothing to it.
std::string shell_word(const std::string& word);
/// From <!doctype html> to <body>: with the style of all pages, for light and dark screens, and `style` in addition.
std::string page_head(const std::string& title, std::string_view style = {});

} // namespace clothlab::experiments
