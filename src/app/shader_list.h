// The shaders of a folder with what their files declare, for panels and the command line.
#pragma once

#include <filesystem>
#include <vector>

#include "scene/shader_parameters.h"

namespace clothlab::app {

/// The declaration of every cloth shader in a folder, by name. A file whose declarations are wrong, or that cannot be
/// read, is there with its `error`: "FILE:LINE: what is wrong".
std::vector<scene::ShaderDeclaration> read_shader_list(const std::filesystem::path& folder);

/// The shader of a name. Throws SceneError, naming those there are, when there is none.
const scene::ShaderDeclaration& find_shader(const std::vector<scene::ShaderDeclaration>& shaders,
                                            const std::string& name);

} // namespace clothlab::app
