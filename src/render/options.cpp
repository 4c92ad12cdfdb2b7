#include "render/options.h"

#include <cmath>

namespace clothlab::render {

glm::vec3 linear(const glm::vec3& srgb) {
    glm::vec3 result;
    for (int i = 0; i < 3; ++i)
        result[i] = srgb[i] <= 0.04045f ? srgb[i] / 12.92f : std::pow((srgb[i] + 0.055f) / 1.055f, 2.4f);
    return result;
}

} // namespace clothlab::render
