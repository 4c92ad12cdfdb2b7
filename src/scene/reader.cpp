// Scenes and cameras from text, and what must hold between their values.
#include "scene/reader.h"

#include <cstdio>
#include <functional>

namespace clothlab::scene {
namespace {

void check_at(const Scene& scene, const std::function<void(std::size_t pin, const std::string&)>& fail_pin,
              const std::function<void(const std::string&)>& fail) {
    const sim::Cloth& cloth = scene.simulation.cloth;
    const double points = static_cast<double>(cloth.num_width_points) * cloth.num_height_points;
    if (points > max_points) {
        char text[160];
        std::snprintf(text, sizeof text, "cloth: %d x %d points are %.0f; at most %.0f are allowed",
                      cloth.num_width_points, cloth.num_height_points, points, max_points);
        fail(text);
    }
    for (std::size_t i = 0; i < cloth.pinned.size(); ++i) {
        const auto [column, row] = cloth.pinned[i];
        if (column >= 0 && column < cloth.num_width_points && row >= 0 && row < cloth.num_height_points)
            continue;
        fail_pin(i, "cloth.pinned[" + std::to_string(i) + "]: [" + std::to_string(column) + ", " + std::to_string(row) +
                        "] is outside the grid; columns are 0 to " + std::to_string(cloth.num_width_points - 1) +
                        " and rows 0 to " + std::to_string(cloth.num_height_points - 1));
    }
}

} // namespace

Scene read_scene(std::string_view text, const std::string& source) {
    const Document document = Document::parse(text, source);
    Reader reader(document);
    Scene scene = reader.scene();
    const auto fail_pin = [&](std::size_t pin, const std::string& what) { document.fail(*reader.pins[pin], "", what); };
    check_at(scene, fail_pin, [&](const std::string& what) {
        const Node* cloth = document.root.find("cloth");
        document.fail(cloth ? *cloth : document.root, "", what);
    });
    return scene;
}

void check(const Scene& scene, const std::string& source) {
    const auto fail = [&](const std::string& what) { throw SceneError(source + ": " + what); };
    check_at(
        scene, [&](std::size_t, const std::string& what) { fail(what); }, fail);
}

Camera read_camera(std::string_view text, const std::string& source) {
    const Document document = Document::parse(text, source);
    Scene scene;
    scene.camera.emplace();
    Reader(document).section(document.root, "camera", scene);
    return *scene.camera;
}

} // namespace clothlab::scene
