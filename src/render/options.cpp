#include "render/options.h"

#include "render/image.h"

namespace clothlab::render {

glm::vec3 linear(const glm::vec3& srgb) {
    return {linear_from_srgb(srgb.x), linear_from_srgb(srgb.y), linear_from_srgb(srgb.z)};
}

} // namespace clothlab::render
