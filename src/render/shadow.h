// The shadow that the first light casts: what the light sees, as a texture of depths, with which each lit point is
// compared (L. Williams, "Casting curved shadows on curved surfaces", SIGGRAPH 1978). shaders/common/lighting.glsl does
// the comparing.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <glm/glm.hpp>

#include "render/gl.h"
#include "sim/description.h"
#include "sim/snapshot.h"

namespace clothlab::render {

struct Box {
    glm::vec3 low, high; ///< m
};

/// The box around all that casts a shadow: the cloth's points that are drawn, and the spheres. Planes cast none.
/// Nothing without any.
std::optional<Box> shadow_casters(const sim::Snapshot* snapshot, std::span<const std::uint8_t> drawn,
                                  std::span<const sim::Collider> colliders);

/// How a light sees the scene.
struct ShadowView {
    glm::mat4 view, projection; ///< as a camera's
    /// How far in front of a surface the map is to be asked where light grazes it, in m, at 1 m from the light: what
    /// three texels of a coarse map cover.
    float ahead;
};

/// A view from a light that has all of a box in it, on a map of so many texels in a row. From within the box or close
/// to it a light sees what is in front of it, up to 75° to the sides; the rest is then without a shadow. The box is
/// taken a little larger, in steps, so that texels stay where they are while a cloth moves a little.
ShadowView shadow_view(const glm::vec3& light, const Box& box, int size);

/// Clip space to the place in the map and the depth there, 0 to 1.
glm::mat4 clip_to_map();

class ShadowMap {
public:
    /// The texture unit that the map is bound to while a picture is drawn: the last that every driver has.
    static constexpr int unit = 15;

    /// Texels in a row: fewer where the driver draws on the CPU.
    int size() const;

    /// Directs drawing here, depth alone, and empties the map. Makes the map at first use. Throws std::runtime_error
    /// when the driver has not the memory.
    void begin();
    /// Directs drawing to where it was before begin(), and binds the map to its unit.
    void end();

private:
    void allocate();

    Texture depth_;
    Framebuffer framebuffer_;
    GLint previous_ = 0, viewport_[4] = {};
    bool scissor_ = false;
};

} // namespace clothlab::render
