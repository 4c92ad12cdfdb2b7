#include "render/offscreen.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

namespace clothlab::render {

Image read_framebuffer(GLuint framebuffer, int width, int height) {
    GLint before = 0, alignment = 4, pack_buffer = 0;
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &before);
    glGetIntegerv(GL_PACK_ALIGNMENT, &alignment);
    glGetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &pack_buffer);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    const std::size_t stride = static_cast<std::size_t>(width) * 4, rows = static_cast<std::size_t>(height);
    std::vector<std::uint8_t> bottom_up(stride * rows);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bottom_up.data());
    glPixelStorei(GL_PACK_ALIGNMENT, alignment);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(before));
    glBindBuffer(GL_PIXEL_PACK_BUFFER, static_cast<GLuint>(pack_buffer));

    Image image{width, height, std::vector<std::uint8_t>(bottom_up.size())};
    for (std::size_t y = 0; y < rows; ++y)
        std::memcpy(&image.rgba[y * stride], &bottom_up[(rows - 1 - y) * stride], stride);
    return image;
}

Target::Target(int width, int height, int samples) {
    require_gl();
    samples_colour_ = Renderbuffer::create();
    samples_depth_ = Renderbuffer::create();
    colour_ = Texture::create();
    multisampled_ = Framebuffer::create();
    resolved_ = Framebuffer::create();
    set_samples(samples);
    resize(width, height);
}

void Target::set_samples(int samples) {
    GLint available = 1;
    glGetIntegerv(GL_MAX_SAMPLES, &available);
    samples = std::clamp(samples, 1, std::max(1, available));
    if (samples == samples_)
        return;
    samples_ = samples;
    if (width_ > 0)
        allocate();
}

void Target::resize(int width, int height) {
    GLint limit = 0, renderbuffer_limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &renderbuffer_limit);
    limit = std::max(1, std::min(limit, renderbuffer_limit));
    width = std::clamp(width, 1, limit);
    height = std::clamp(height, 1, limit);
    if (width == width_ && height == height_)
        return;
    width_ = width;
    height_ = height;
    allocate();
}

void Target::allocate() {
    GLint texture_before = 0, renderbuffer_before = 0, draw_before = 0, read_before = 0;
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &texture_before);
    glGetIntegerv(GL_RENDERBUFFER_BINDING, &renderbuffer_before);
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_before);
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_before);

    // One sample is a buffer that is not multisampled: 0 for OpenGL.
    const GLsizei samples = samples_ > 1 ? samples_ : 0;
    glBindRenderbuffer(GL_RENDERBUFFER, samples_colour_.id());
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_SRGB8_ALPHA8, width_, height_);
    glBindRenderbuffer(GL_RENDERBUFFER, samples_depth_.id());
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT24, width_, height_);
    glBindFramebuffer(GL_FRAMEBUFFER, multisampled_.id());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, samples_colour_.id());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, samples_depth_.id());
    bool complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;

    // Not an sRGB texture: whoever shows it would have it converted to linear values on the way.
    glBindTexture(GL_TEXTURE_2D, colour_.id());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width_, height_, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glBindFramebuffer(GL_FRAMEBUFFER, resolved_.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_.id(), 0);
    complete = complete && glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;

    glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(texture_before));
    glBindRenderbuffer(GL_RENDERBUFFER, static_cast<GLuint>(renderbuffer_before));
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw_before));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_before));
    if (complete)
        return;
    const std::string size = std::to_string(width_) + " x " + std::to_string(height_);
    while (glGetError() != GL_NO_ERROR) {
    }
    width_ = height_ = 0; // so that the next resize tries again
    throw std::runtime_error("the driver has no framebuffer of " + size + " pixels with " + std::to_string(samples_) +
                             " samples");
}

void Target::bind() {
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &previous_);
    glBindFramebuffer(GL_FRAMEBUFFER, multisampled_.id());
    glViewport(0, 0, width_, height_);
    glEnable(GL_FRAMEBUFFER_SRGB);
    glEnable(GL_MULTISAMPLE);
}

void Target::resolve() {
    // With conversion off, the encoded values are averaged and copied as they are.
    glDisable(GL_FRAMEBUFFER_SRGB);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, multisampled_.id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.id());
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(previous_));
}

void Target::unbind() {
    glDisable(GL_FRAMEBUFFER_SRGB);
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(previous_));
}

void Target::copy_to_window() const {
    glDisable(GL_FRAMEBUFFER_SRGB);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, multisampled_.id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

Image Target::read() const {
    return read_framebuffer(resolved_.id(), width_, height_);
}

} // namespace clothlab::render
