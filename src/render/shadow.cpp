#include "render/shadow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <glm/gtc/matrix_transform.hpp>

#include "render/collider_mesh.h"

namespace clothlab::render {

namespace {

constexpr float beyond = std::numeric_limits<float>::max();
constexpr int coarse = 1024; ///< texels in a row of the map where the driver draws on the CPU
/// How far to the side a light sees at the most, as a tangent.
constexpr float widest = 3.7f;

void include(Box& box, const glm::vec3& low, const glm::vec3& high) {
    box.low = glm::min(box.low, low);
    box.high = glm::max(box.high, high);
}

/// The box around points that are all drawn; four at a time, so that the loop can be one of vectors.
void include_all(Box& box, std::span<const float> positions) {
    constexpr std::size_t lanes = 12;
    std::array<float, lanes> low, high;
    low.fill(beyond);
    high.fill(-beyond);
    std::size_t i = 0;
    for (; i + lanes <= positions.size(); i += lanes) {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const float value = positions[i + lane];
            low[lane] = value < low[lane] ? value : low[lane];
            high[lane] = value > high[lane] ? value : high[lane];
        }
    }
    for (std::size_t lane = 0; lane < lanes; lane += 3)
        include(box, {low[lane], low[lane + 1], low[lane + 2]}, {high[lane], high[lane + 1], high[lane + 2]});
    for (; i + 3 <= positions.size(); i += 3) {
        const glm::vec3 p(positions[i], positions[i + 1], positions[i + 2]);
        include(box, p, p);
    }
}

/// Outwards to whole steps of a sixteenth of the size at the most.
Box rounded(const Box& box) {
    const glm::vec3 extent = box.high - box.low;
    const float size = std::max({extent.x, extent.y, extent.z, 1e-3f});
    const float step = std::exp2(std::floor(std::log2(size)) - 4);
    return {glm::floor(box.low / step) * step, glm::ceil(box.high / step) * step};
}

} // namespace

std::optional<Box> shadow_casters(const sim::Snapshot* snapshot, std::span<const std::uint8_t> drawn,
                                  std::span<const sim::Collider> colliders) {
    Box box{glm::vec3(beyond), glm::vec3(-beyond)};
    if (snapshot != nullptr && 3 * drawn.size() == snapshot->positions.size()) {
        const std::span<const float> positions = snapshot->positions;
        if (std::find(drawn.begin(), drawn.end(), std::uint8_t{0}) == drawn.end()) {
            include_all(box, positions);
        } else {
            for (std::size_t i = 0; i < drawn.size(); ++i)
                if (drawn[i] != 0)
                    include_all(box, positions.subspan(3 * i, 3));
        }
    }
    for (const sim::Collider& collider : colliders) {
        const auto* given = std::get_if<sim::Sphere>(&collider);
        if (const auto sphere = given != nullptr ? drawable_sphere(*given) : std::nullopt)
            include(box, glm::vec3(*sphere) - sphere->w, glm::vec3(*sphere) + sphere->w);
    }
    if (box.low.x > box.high.x)
        return {};
    return box;
}

ShadowView shadow_view(const glm::vec3& light, const Box& box, int size) {
    const Box casters = rounded(box);
    const glm::vec3 centre = 0.5f * (casters.low + casters.high);
    const glm::vec3 path = centre - light;
    const float distance = glm::length(path), radius = glm::length(casters.high - centre);
    const glm::vec3 forward = distance > 1e-6f * radius ? path / distance : glm::vec3(0, -1, 0);
    const glm::vec3 up = std::abs(forward.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
    ShadowView result{glm::lookAt(light, light + forward, up), glm::mat4(1), 0};

    // Where the box's corners are in the light's picture. Nearer than this, they are to the side of the light.
    const float nearest = 0.01f * (distance + radius);
    float near_plane = beyond, far_plane = 2 * nearest;
    glm::vec2 low(widest), high(-widest);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::bvec3 upper((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0);
        const glm::vec3 at = glm::vec3(result.view * glm::vec4(glm::mix(casters.low, casters.high, upper), 1));
        const float depth = -at.z;
        near_plane = std::min(near_plane, depth);
        far_plane = std::max(far_plane, depth);
        if (depth < nearest) {
            low = glm::vec2(-widest);
            high = glm::vec2(widest);
        } else {
            low = glm::min(low, glm::vec2(at) / depth);
            high = glm::max(high, glm::vec2(at) / depth);
        }
    }
    low = glm::clamp(low, -widest, widest - 0.01f);
    high = glm::clamp(high, low + 0.001f, glm::vec2(widest));
    // Texels at the rim are not compared with: what is beside the map is lit.
    const glm::vec2 rim = (high - low) * (4.f / static_cast<float>(size));
    low -= rim;
    high += rim;
    near_plane = std::max(near_plane, nearest);
    result.projection = glm::frustum(low.x * near_plane, high.x * near_plane, low.y * near_plane, high.y * near_plane,
                                     near_plane, 1.01f * far_plane);
    result.ahead = std::max(high.x - low.x, high.y - low.y) * 3 / coarse;
    return result;
}

glm::mat4 clip_to_map() {
    return glm::translate(glm::mat4(1), glm::vec3(0.5f)) * glm::scale(glm::mat4(1), glm::vec3(0.5f));
}

int ShadowMap::size() const {
    return software_rendering() ? coarse : 2 * coarse;
}

void ShadowMap::allocate() {
    depth_ = Texture::create();
    framebuffer_ = Framebuffer::create();
    glBindTexture(GL_TEXTURE_2D, depth_.id());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, size(), size(), 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT,
                 nullptr);
    // Comparing before filtering is percentage-closer filtering of 2 x 2 texels (W. T. Reeves, D. H. Salesin, R. L.
    // Cook, "Rendering antialiased shadows with depth maps", SIGGRAPH 1987). Beside the map all is lit.
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    const float furthest[] = {1, 1, 1, 1};
    glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, furthest);
    glBindTexture(GL_TEXTURE_2D, 0);

    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.id(), 0);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        depth_ = Texture();
        framebuffer_ = Framebuffer();
        glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(previous_));
        throw std::runtime_error("the graphics driver cannot make the shadow map");
    }
}

void ShadowMap::begin() {
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &previous_);
    glGetIntegerv(GL_VIEWPORT, viewport_);
    scissor_ = glIsEnabled(GL_SCISSOR_TEST) == GL_TRUE;
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_2D, 0); // what is drawn into must not be read
    if (!depth_)
        allocate();
    glActiveTexture(GL_TEXTURE0);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glDisable(GL_SCISSOR_TEST);
    glViewport(0, 0, size(), size());
    glClearDepth(1);
    glClear(GL_DEPTH_BUFFER_BIT);
    // Surfaces are taken for a little further away, the more so the more they slope.
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1.5f, 4.f);
}

void ShadowMap::end() {
    glDisable(GL_POLYGON_OFFSET_FILL);
    if (scissor_)
        glEnable(GL_SCISSOR_TEST);
    glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(previous_));
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_2D, depth_.id());
    glActiveTexture(GL_TEXTURE0);
}

} // namespace clothlab::render
