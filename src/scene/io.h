// Scenes as text and as files: the course's format, and ours, a versioned superset of it (docs/scenes.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "scene/error.h"
#include "scene/scene.h"

namespace clothlab::scene {

inline constexpr int format_version = 1;

/// Reads a scene. `source` names it in errors. Throws SceneError with the place for anything that is not exactly right:
/// an unknown, missing or repeated key, a wrong type, a value that is not allowed.
Scene read_scene(std::string_view text, const std::string& source);

/// Writes a scene in our own format, every value explicit; read_scene gives back the same scene to the last bit.
std::string write_scene(const Scene& scene);

/// Reads a file. Throws SceneError, also when it cannot be read or is a folder.
Scene load_scene(const std::filesystem::path& file);

/// Writes a file so that a crash at any moment leaves the old or the new file whole. Throws SceneError.
void save_scene(const Scene& scene, const std::filesystem::path& file);

/// Sets one parameter from text: `key` as in fields(), or `rules` (all at once), `name`, `description`, `cloth.pinned`,
/// `simulation.accelerations`, `look.shaders.SHADER.PARAMETER`, `sphere.*` and `plane.*` (the first of that kind),
/// `colliders.N.*`, or `colliders.N` with the value `none`, which takes that collider away: those behind it move up.
/// Throws SceneError. Call check() after the last one.
void set_parameter(Scene& scene, std::string_view key, std::string_view value);

/// Throws SceneError for values that do not go together (a pin outside the grid, too many points). `source` begins the
/// sentence.
void check(const Scene& scene, const std::string& source);

/// A camera as JSON text with the keys of a scene's "camera", for files and the clipboard. Throws SceneError.
Camera read_camera(std::string_view text, const std::string& source);
/// The text that read_camera reads back to the last bit.
std::string write_camera(const Camera& camera);

/// No scene or camera file is larger, in bytes.
inline constexpr std::uintmax_t max_text_size = 64u << 20;

/// The whole text of a file. Throws SceneError when it cannot be read, is a folder or is larger than allowed.
std::string read_text_file(const std::filesystem::path& file, std::uintmax_t max_size = max_text_size);

/// Writes a text so that a crash at any moment leaves the old or the new file whole. Throws SceneError.
void write_text_file(const std::string& text, const std::filesystem::path& file);

} // namespace clothlab::scene
