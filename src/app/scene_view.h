// From a scene's camera and look to what the renderer takes.
#pragma once

#include "render/renderer.h"
#include "scene/scene.h"

namespace clothlab::app {

render::View to_view(const scene::Camera& camera);
/// `scene` and `snapshot` must outlive the result.
render::Scene to_render(const scene::Scene& scene, const sim::Snapshot* snapshot);

}  // namespace clothlab::app
