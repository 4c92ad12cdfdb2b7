// A framebuffer of our own to draw into: the viewport panel shows its texture, and without a display it is the picture.
#pragma once

#include "render/gl.h"
#include "render/image.h"

namespace clothlab::render {

/// The pixels of a framebuffer without samples; 0 is the window. Their values as they are, no conversion.
Image read_framebuffer(GLuint framebuffer, int width, int height);

/// A multisampled colour (sRGB) and depth buffer, and the texture it is resolved into.
class Target {
public:
    /// Sizes in pixels; samples is what is wished for, the driver may have fewer.
    explicit Target(int width = 1, int height = 1, int samples = 4);

    /// Changes the size; the picture is then undefined until the next draw. Nothing happens when the size is the same;
    /// sizes below 1 are raised to 1, those above the driver's limit lowered to it. Throws std::runtime_error when the
    /// driver has not the memory.
    void resize(int width, int height);
    /// Changes the number of samples, like resize(); the driver may have fewer.
    void set_samples(int samples);
    int width() const { return width_; }
    int height() const { return height_; }
    int samples() const { return samples_; }

    /// The resolved picture, of format RGBA8 that holds sRGB values: shown as it is, no conversion. The bottom row
    /// first, as OpenGL has it: an ImGui image takes uv (0, 1) to (1, 0). Stays the same texture over resizes.
    GLuint texture() const { return colour_.id(); }

    /// Directs drawing here and sets the viewport. sRGB conversion on write is switched on until resolve() or unbind().
    void bind();
    /// Resolves the samples into texture() and directs drawing to the framebuffer that was bound before bind().
    void resolve();
    /// Directs drawing to the framebuffer that was bound before bind(), without resolving.
    void unbind();
    /// Copies a picture without samples into the window, framebuffer 0, as it is.
    void copy_to_window() const;
    /// The resolved picture.
    Image read() const;

private:
    void allocate();

    int width_ = 0, height_ = 0, samples_ = 0;
    GLint previous_ = 0;
    Renderbuffer samples_colour_, samples_depth_;
    Texture colour_;
    Framebuffer multisampled_, resolved_;
};

} // namespace clothlab::render
