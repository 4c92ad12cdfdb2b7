#include "app/gui/window_picture.h"

#include <glad/gl.h>

namespace clothlab::app {

WindowPicture::WindowPicture(Window& window, ImGuiLayer& imgui) : window_(window), imgui_(imgui) {
    if (window.kind() == Window::Kind::offscreen || render::software_rendering())
        kept_.emplace(1, 1, 1);
}

bool WindowPicture::draw(unsigned new_contents) {
    int width = 0, height = 0;
    window_.framebuffer_size(width, height);
    if (!kept_) {
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glViewport(0, 0, width, height);
        imgui_.end_frame();
        return true;
    }
    if (width != kept_->width() || height != kept_->height()) {
        kept_->resize(width, height);
        imgui_.forget_last();
    }
    kept_->bind();
    glDisable(GL_FRAMEBUFFER_SRGB); // the interface's colours are sRGB already
    changed_ = imgui_.end_frame_over_last(new_contents);
    changed_ = window_.take_uncovered() || changed_;
    kept_->unbind();
    return changed_;
}

render::Image WindowPicture::read() {
    if (kept_) {
        kept_->bind();
        kept_->resolve();
        return kept_->read();
    }
    int width = 0, height = 0;
    window_.framebuffer_size(width, height);
    render::Image image = render::read_framebuffer(0, width, height);
    for (std::size_t i = 3; i < image.rgba.size(); i += 4)
        image.rgba[i] = 255; // windows need no alpha and may have any
    return image;
}

void WindowPicture::show() {
    if (window_.kind() == Window::Kind::offscreen || !changed_)
        return;
    if (kept_)
        kept_->copy_to_window();
    window_.swap();
}

} // namespace clothlab::app
