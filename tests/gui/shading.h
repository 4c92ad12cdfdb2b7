// What the tests of shading share: where a pixel looks at, the formulas of light on the CPU, and pictures as textures.
#pragma once

#include <cmath>
#include <initializer_list>

#include "gui/render_fixture.h"
#include "render/image.h"

namespace clothlab::test {

inline double srgb_of(double linear) {
    linear = std::clamp(linear, 0.0, 1.0);
    return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

inline double linear_of(double byte) {
    return render::linear(glm::vec3(static_cast<float>(byte / 255))).x;
}

/// The point at a height that a pixel's middle looks at.
inline glm::vec3 seen_at(const render::View& view, const render::Image& image, int x, int y, float height) {
    const float aspect = static_cast<float>(image.width) / static_cast<float>(image.height);
    const glm::mat4 from_clip = glm::inverse(render::projection_matrix(view, aspect) * render::view_matrix(view));
    const glm::vec2 at = {2 * (static_cast<float>(x) + 0.5f) / static_cast<float>(image.width) - 1,
                          1 - 2 * (static_cast<float>(y) + 0.5f) / static_cast<float>(image.height)};
    const glm::vec4 far = from_clip * glm::vec4(at, 0.5f, 1);
    const glm::vec3 ray = glm::vec3(far) / far.w - view.eye;
    return view.eye + (height - view.eye.y) / ray.y * ray;
}

/// Light by the course's formulas, at a point with the unit normal of the side that is seen.
struct Lighting {
    const render::Options& options;
    glm::vec3 eye, position, normal;

    /// The sum over the lamps of I / r² times a function of the unit vector to the lamp.
    template <class Share>
    float lamps(Share share) const {
        float sum = 0;
        for (const render::Light& lamp : options.lights) {
            const glm::vec3 path = lamp.position - position;
            sum += lamp.intensity / glm::dot(path, path) * share(glm::normalize(path));
        }
        return sum;
    }
    /// I / r² max(0, n·l)
    float diffuse() const {
        return lamps([this](const glm::vec3& l) { return std::max(0.f, glm::dot(normal, l)); });
    }
    /// I / r² max(0, n·h)^p
    float specular(float p) const {
        const glm::vec3 to_eye = glm::normalize(eye - position);
        return lamps([&](const glm::vec3& l) {
            return std::pow(std::max(0.f, glm::dot(normal, glm::normalize(l + to_eye))), p);
        });
    }
    /// I / r² max(0, -n·l): from the other side.
    float behind() const {
        return lamps([this](const glm::vec3& l) { return std::max(0.f, -glm::dot(normal, l)); });
    }
};

/// Linear values as the pixel's bytes, within 1 of 255.
inline void check_pixel(const render::Image& image, int x, int y, const glm::vec3& linear, double margin = 1) {
    INFO("pixel " << x << ", " << y);
    for (int k = 0; k < 3; ++k)
        CHECK(std::abs(image.pixel(x, y)[k] - srgb_of(linear[k])) <= margin);
}

/// A picture whose pixels a function of column and row (from the top) gives, as an sRGB byte or as three of them.
template <class Colour>
std::string write_picture(const std::filesystem::path& file, int width, int height, Colour colour_at) {
    render::Image image{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::ivec3 colour(colour_at(x, y));
            for (const int value : {colour.x, colour.y, colour.z, 255})
                image.rgba.push_back(static_cast<std::uint8_t>(value));
        }
    render::write_png(image, file);
    return file.string();
}

/// A lamp over the edge of a flat cloth, and another that is weaker and further away; nothing else.
inline void set_two_lamps(render::Options& options) {
    options.lights = {render::Light{{0.4f, 0.6f, 0.1f}, 0.22f}, render::Light{{-1, 1.5f, -0.5f}, 0.5f}};
    options.ambient = options.fill = 0;
}

} // namespace clothlab::test
