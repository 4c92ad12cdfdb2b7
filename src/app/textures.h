// The user's own pictures in a scene's look: paths relative to the scene's file, and which parameter a picture is for.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/shader_parameters.h"

namespace clothlab::app {

/// Makes the paths of pictures in a look, which a scene's file has relative to its own folder, paths from anywhere.
/// Names of textures that the program comes with stay as they are.
void resolve_textures(scene::Look& look, const std::vector<scene::ShaderDeclaration>& shaders,
                      const std::filesystem::path& folder);
/// The other way: a picture in the folder of the scene's file, or below it, is named from there, so that both can be
/// moved together.
void relate_textures(scene::Look& look, const std::vector<scene::ShaderDeclaration>& shaders,
                     const std::filesystem::path& folder);

/// The parameter of a shader that a picture, dropped onto the window, is for: an environment for a panorama (.hdr),
/// else the first texture of colours, heights or a ramp. None where the shader takes no picture.
const scene::ShaderParameter* parameter_for_picture(const scene::ShaderDeclaration& shader,
                                                    const std::filesystem::path& picture);

/// The colours of a ramp from left to right, sRGB, of a built-in texture or a picture's middle row; none when it cannot
/// be read.
std::vector<std::array<float, 3>> ramp_colours(const std::string& name);

/// Whether a file's name ends as those of pictures do that can be a texture.
bool is_picture(const std::filesystem::path& file);

} // namespace clothlab::app
