// Draws scenes into pictures of a size of their own, whatever the window's is.
#pragma once

#include <vector>

#include "app/trace_view.h"
#include "render/renderer.h"
#include "scene/shader_parameters.h"

namespace clothlab::app {

class PictureMaker {
public:
    /// A transparent picture has no background: alpha is 0 where nothing is drawn. `samples` per pixel. The renderer
    /// must outlive this. Throws std::runtime_error when the driver cannot draw pictures of that size.
    PictureMaker(render::Renderer& renderer, int width, int height, int samples, bool transparent);

    int width() const { return target_.width(); }
    int height() const { return target_.height(); }

    /// With a ghost where there is one (render::Scene::ghost), and with the inside of a step. Throws
    /// render::ShaderError as the renderer does.
    render::Image draw(const scene::Scene& scene, const std::vector<scene::ShaderDeclaration>& shaders,
                       const sim::Snapshot* snapshot, const sim::Snapshot* ghost = nullptr,
                       const TraceChoice& inside = {});

private:
    render::Renderer& renderer_;
    render::Target target_;
    TraceView trace_view_;
    bool transparent_;
};

} // namespace clothlab::app
