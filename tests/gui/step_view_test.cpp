// What is computed from a trace for the panel and the picture: picking, stages, scales, arrows.
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "app/trace_view.h"
#include "gui/render_fixture.h"
#include "sim/random.h"
#include "sim/simulation.h"
#include "ui/step_view.h"

namespace clothlab::test {
namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

double uniform(sim::SplitMix64& random, double low, double high) {
    return low + (high - low) * random.unit();
}

/// Where a point is in a picture, by the renderer's matrices: px from the left upper corner.
glm::dvec2 pixel_of(const scene::Camera& camera, const glm::vec3& point, float width, float height) {
    const render::View view = app::to_view(camera, static_cast<double>(width / height));
    const glm::vec4 clip =
        render::projection_matrix(view, width / height) * render::view_matrix(view) * glm::vec4(point, 1);
    return {static_cast<double>((clip.x / clip.w + 1) * width / 2),
            static_cast<double>((1 - clip.y / clip.w) * height / 2)};
}

sim::Description falling_on_a_sphere() {
    sim::Description d;
    d.cloth.num_width_points = d.cloth.num_height_points = 10;
    d.cloth.enable_bending = false;
    d.colliders = {sim::Sphere{{0.5, 0.8, 0.5}, 0.19, 0.3}};
    d.rules.self_collision = sim::SelfCollisionRule::none;
    return d;
}

/// Of the first step in which the sphere is touched, with the state before it.
std::pair<std::shared_ptr<const sim::StepTrace>, sim::Snapshot> contact() {
    const auto run = sim::Simulation::create(falling_on_a_sphere());
    while (run->trace_step().counts.contacts == 0)
        run->step();
    std::pair<std::shared_ptr<const sim::StepTrace>, sim::Snapshot> result;
    result.first = std::make_shared<const sim::StepTrace>(run->trace_step());
    run->capture(result.second);
    return result;
}

constexpr int forces = static_cast<int>(sim::Stage::forces), integrate = static_cast<int>(sim::Stage::integrate),
              colliders = static_cast<int>(sim::Stage::colliders), limit = static_cast<int>(sim::Stage::limit);

} // namespace

TEST_CASE("A point is picked where the renderer draws it, with any camera and picture") {
    sim::SplitMix64 random(3);
    int in_the_picture = 0;
    for (int n = 0; n < 200; ++n) {
        scene::Camera camera;
        camera.yaw = uniform(random, -180, 180);
        camera.pitch = uniform(random, -80, 80);
        camera.distance = uniform(random, 1.5, 4);
        camera.fov = uniform(random, 20, 90);
        if (n % 2 == 1)
            camera.projection = scene::Projection::orthographic;
        const auto width = static_cast<float>(uniform(random, 200, 900)),
                   height = static_cast<float>(uniform(random, 200, 900));
        std::vector<float> positions;
        for (int i = 0; i < 15; ++i)
            positions.push_back(static_cast<float>(uniform(random, 0, 1)));
        const glm::vec3 wanted{positions[6], positions[7], positions[8]};
        const glm::dvec2 at = pixel_of(camera, wanted, width, height);
        bool alone = true;
        for (std::size_t i = 0; i < 5; ++i)
            if (i != 2)
                alone &= glm::length(pixel_of(camera, {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]},
                                              width, height) -
                                     at) > 8;
        if (!alone)
            continue;
        ++in_the_picture;
        const auto x = static_cast<float>(at.x), y = static_cast<float>(at.y);
        CHECK(ui::pick_point(camera, width, height, positions, x, y) == 2u);
        CHECK(ui::pick_point(camera, width, height, positions, x + 2, y - 2) == 2u);
        CHECK(ui::pick_point(camera, width, height, positions, x + 2, y - 2, 1) == std::nullopt);
    }
    CHECK(in_the_picture > 100);
}

TEST_CASE("Of two points in one place of the picture the nearer one is picked, and none behind the eye") {
    scene::Camera camera;
    camera.target = {0, 0, 0};
    camera.yaw = camera.pitch = 0;
    camera.distance = 2;
    for (const scene::Projection projection : {scene::Projection::perspective, scene::Projection::orthographic}) {
        camera.projection = projection;
        CHECK(ui::pick_point(camera, 300, 200, std::vector<float>{0, 0, -0.5f, 0, 0, 0.5f}, 150, 100) == 1u);
        CHECK(ui::pick_point(camera, 300, 200, std::vector<float>{0, 0, 0.5f, 0, 0, -0.5f}, 151, 100) == 0u);
        CHECK(ui::pick_point(camera, 300, 200, std::vector<float>{}, 150, 100) == std::nullopt);
    }
    camera.projection = scene::Projection::perspective;
    CHECK(ui::pick_point(camera, 300, 200, std::vector<float>{0, 0, 3}, 150, 100) == std::nullopt);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(ui::pick_point(camera, 300, 200, std::vector<float>{nan, 0, 0, 0, 0, 0}, 150, 100) == 1u);
}

TEST_CASE("Going through the stages leaves out those that the scene does not have and ends at both ends") {
    sim::StepTrace trace;
    trace.active = {true, true, false, true, false};
    CHECK(ui::next_stage(trace, -1, 1) == forces);
    CHECK(ui::next_stage(trace, forces, 1) == integrate);
    CHECK(ui::next_stage(trace, integrate, 1) == colliders);
    CHECK(ui::next_stage(trace, colliders, 1) == colliders);
    CHECK(ui::next_stage(trace, colliders, -1) == integrate);
    CHECK(ui::next_stage(trace, forces, -1) == -1);
    CHECK(ui::next_stage(trace, -1, -1) == -1);
}

TEST_CASE("In free fall from rest the force's arrow is what the method then moves the point") {
    sim::Description d = falling_on_a_sphere();
    d.colliders.clear();
    const sim::StepTrace trace = sim::Simulation::create(d)->trace_step();
    for (std::uint32_t i = 0; i < 100; ++i) {
        const sim::Vec3 force = ui::effect(trace, sim::Stage::forces, i),
                        moved = ui::effect(trace, sim::Stage::integrate, i);
        CHECK_THAT(force.y, WithinRel(-9.8 * trace.dt * trace.dt, 1e-5));
        CHECK_THAT(moved.y, WithinAbs(force.y, 1.2e-7)); // a float's last place at 1 m
    }
}

TEST_CASE("Arrows that are fitted have a length that can be seen") {
    const auto [trace, snapshot] = contact();
    const double spacing = ui::mean_spacing(10, 10, trace->before);
    CHECK_THAT(spacing, WithinRel(1.0 / 9, 0.02));
    const auto length = [&step = *trace](sim::Stage stage, std::uint32_t point) {
        const sim::Vec3 d = ui::effect(step, stage, point);
        return std::hypot(d.x, d.y, d.z);
    };
    for (const sim::Stage stage : {sim::Stage::forces, sim::Stage::integrate, sim::Stage::colliders}) {
        const auto scale = ui::fitting_scale(*trace, stage, std::nullopt, spacing);
        REQUIRE(scale);
        double squares = 0, longest = 0, count = 0;
        for (std::uint32_t i = 0; i < 100; ++i) {
            const double drawn = static_cast<double>(*scale) * length(stage, i);
            squares += drawn * drawn;
            count += drawn > 0 ? 1 : 0;
            longest = std::max(longest, drawn);
        }
        const double rms = std::sqrt(squares / count);
        CHECK(rms < 1.5001 * spacing);
        CHECK(longest < 6.0001 * spacing);
        CHECK((rms > 1.4999 * spacing || longest > 5.9999 * spacing));
    }
    const std::uint32_t touched = trace->furthest[static_cast<std::size_t>(colliders)];
    const auto alone = ui::fitting_scale(*trace, sim::Stage::colliders, touched, spacing);
    REQUIRE(alone);
    CHECK_THAT(static_cast<double>(*alone) * length(sim::Stage::colliders, touched), WithinRel(5 * spacing, 1e-5));
    CHECK_FALSE(ui::fitting_scale(*trace, sim::Stage::colliders, 0, spacing)); // a corner, far from the sphere
}

TEST_CASE("The picture of a stage has the cloth after it, and arrows where it moved points") {
    const auto [trace, snapshot] = contact();
    app::TraceView view;
    const auto shown = [&, &step = trace, &from = snapshot](int stage, std::optional<std::uint32_t> picked = {},
                                                            float scale = 1) {
        render::Scene scene;
        scene.snapshot = &from;
        view.show({step, stage, picked, scale}, scene);
        return scene;
    };
    render::Scene untouched;
    untouched.snapshot = &snapshot;
    view.show({}, untouched);
    CHECK(untouched.snapshot == &snapshot);
    CHECK(untouched.arrows.empty());

    const render::Scene before = shown(-1);
    CHECK(before.snapshot->positions == snapshot.positions);
    CHECK(before.arrows.empty());
    CHECK_FALSE(before.marker);

    const auto at = static_cast<std::size_t>(colliders);
    const render::Scene after = shown(colliders, {}, 10);
    CHECK(after.snapshot->positions == trace->after[at]);
    CHECK(after.snapshot->positions != snapshot.positions);
    CHECK(after.snapshot->capture == 0); // or the mesh would keep what it has
    CHECK(after.arrows.size() == trace->moved[at]);
    REQUIRE_FALSE(after.arrows.empty());
    for (const render::Arrow& arrow : after.arrows) { // out of the sphere
        const glm::vec3 out = arrow.from - glm::vec3(0.5f, 0.8f, 0.5f);
        CHECK(glm::dot(arrow.to - arrow.from, out) > 0);
    }

    const std::uint32_t point = trace->furthest[at];
    const render::Scene one = shown(colliders, point, 10);
    REQUIRE(one.arrows.size() == 1);
    REQUIRE(one.marker);
    CHECK(*one.marker == one.arrows[0].from);
    CHECK_THAT(static_cast<double>(glm::length(one.arrows[0].to - one.arrows[0].from)),
               WithinRel(10 * trace->max_moved[at], 1e-3));
    const render::Scene corner = shown(colliders, 0);
    CHECK(corner.arrows.empty());
    CHECK(corner.marker);
    CHECK(shown(forces).arrows.size() == 100);
    CHECK(shown(limit).snapshot->positions == trace->after[static_cast<std::size_t>(limit)]);
    CHECK(shown(limit, 1000).arrows.empty()); // of a grid that is gone
}

} // namespace clothlab::test
