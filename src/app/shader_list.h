// The shaders of a folder with what their files declare, for panels and the command line.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "render/shader_files.h"
#include "scene/shader_parameters.h"

namespace clothlab::app {

/// The declaration of every cloth shader in the folders, by name. A file whose declarations are wrong, or that cannot
/// be read, is there with its `error`: "FILE:LINE: what is wrong". Places of wrong declarations are put into `faults`,
/// where it is given, by the shader's name.
std::vector<scene::ShaderDeclaration> read_shader_list(const render::ShaderFolders& folders,
                                                       std::map<std::string, render::ShaderFault>* faults = nullptr);

/// The shader of a name. Throws SceneError, naming those there are, when there is none.
const scene::ShaderDeclaration& find_shader(const std::vector<scene::ShaderDeclaration>& shaders,
                                            const std::string& name);

} // namespace clothlab::app
