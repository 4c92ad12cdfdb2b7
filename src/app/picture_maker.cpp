#include "app/picture_maker.h"

#include <stdexcept>
#include <string>

#include "app/scene_view.h"

namespace clothlab::app {

PictureMaker::PictureMaker(render::Renderer& renderer, int width, int height, int samples, bool transparent)
    : renderer_(renderer), target_(width, height, samples), transparent_(transparent) {
    if (target_.width() != width || target_.height() != height)
        throw std::runtime_error("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                                 " pixels cannot be drawn here; at most " + std::to_string(target_.width()) + " x " +
                                 std::to_string(target_.height()) + " can");
}

render::Image PictureMaker::draw(const scene::Scene& scene, const std::vector<scene::ShaderDeclaration>& shaders,
                                 const sim::Snapshot* snapshot, const sim::Snapshot* ghost, const TraceChoice& inside) {
    render::Scene what = to_render(scene, shaders, snapshot, static_cast<double>(target_.width()) / target_.height());
    what.ghost = ghost;
    trace_view_.show(inside, what);
    const auto drawn = [&] {
        renderer_.draw(what, target_);
        return target_.read();
    };
    if (!transparent_)
        return drawn();
    // Twice, so that whatever covers a part of a pixel, edges, fading floors, translucent cloth, is as transparent as
    // it is.
    const auto over = [&](float grey) {
        what.options.background_top = what.options.background_bottom = glm::vec3(grey);
        return drawn();
    };
    return render::transparent(over(0), over(1));
}

} // namespace clothlab::app
