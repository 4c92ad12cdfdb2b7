// The write-up of a session: what was simulated, what was seen, what the experiments found, and how to get it again.
#pragma once

#include <cstdint>
#include <filesystem>

#include "experiments/report.h"
#include "render/renderer.h"
#include "ui/lab.h"

namespace clothlab::app {

inline constexpr const char* session_file = "session.clothrec";

/// The report of what the lab shows, whose state has this hash. Files that it names are relative to its folder.
experiments::Report session_report(const ui::Lab& lab, std::uint64_t hash);

/// Writes report.html, report.md, scene.json, pictures and tables into a folder, which is made where it is missing; the
/// report last. The recording that it names is not among them. Throws std::runtime_error or scene::SceneError when one
/// cannot be written.
void write_session_report(const ui::Lab& lab, render::Renderer& renderer, std::uint64_t hash,
                          const std::filesystem::path& folder);

} // namespace clothlab::app
