// From a scene's camera and look to what the renderer takes.
#pragma once

#include "render/renderer.h"
#include "scene/shader_parameters.h"

namespace clothlab::app {

/// `aspect` is the picture's width / height: the camera's field of view is that of the shorter side.
render::View to_view(const scene::Camera& camera, double aspect);
/// How a look draws with one of the shaders: every parameter that the shader declares, with its value. A shader that is
/// not in the list has no parameters.
render::Surface to_surface(const scene::Look& look, const std::vector<scene::ShaderDeclaration>& shaders,
                           const std::string& shader);
/// Samples per pixel; `automatic` is what that choice stands for.
int samples_of(scene::Multisampling choice, int automatic);
/// What a snapshot needs for a look: the point quantity that the shader colours by, and that of the shader on the right
/// of a split view where it is another.
sim::SnapshotExtras extras_of(const scene::Look& look, const std::vector<scene::ShaderDeclaration>& shaders);
/// `scene` and `snapshot` must outlive the result.
render::Scene to_render(const scene::Scene& scene, const std::vector<scene::ShaderDeclaration>& shaders,
                        const sim::Snapshot* snapshot, double aspect);

} // namespace clothlab::app
