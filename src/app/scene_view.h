// From a scene's camera and look to what the renderer takes.
#pragma once

#include "render/renderer.h"
#include "scene/scene.h"

namespace clothlab::app {

/// `aspect` is the picture's width / height: the camera's field of view is that of the shorter side.
render::View to_view(const scene::Camera& camera, double aspect);
/// `scene` and `snapshot` must outlive the result.
render::Scene to_render(const scene::Scene& scene, const sim::Snapshot* snapshot, double aspect);

} // namespace clothlab::app
