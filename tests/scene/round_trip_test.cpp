// Scenes survive writing and reading to the last bit.
#include <bit>
#include <catch2/catch_test_macros.hpp>

#include "scene/fields.h"
#include "scene/io.h"
#include "support/effort.h"
#include "support/files.h"
#include "support/random_scene.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
bool same_bits(const sim::Vec3& a, const sim::Vec3& b) {
    return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z);
}
bool same_bits(const sim::Collider& a, const sim::Collider& b) {
    if (a.index() != b.index())
        return false;
    if (const auto* s = std::get_if<sim::Sphere>(&a)) {
        const auto& t = std::get<sim::Sphere>(b);
        return same_bits(s->origin, t.origin) && same_bits(s->radius, t.radius) && same_bits(s->friction, t.friction);
    }
    const auto &p = std::get<sim::Plane>(a), &q = std::get<sim::Plane>(b);
    return same_bits(p.point, q.point) && same_bits(p.normal, q.normal) && same_bits(p.friction, q.friction);
}

/// Equality, and equality of bits, which tells 0.0 from -0.0.
void require_same(const scene::Scene& a, const scene::Scene& b) {
    REQUIRE(a == b);
    for (const scene::Field& f : scene::fields()) {
        INFO(f.key);
        if (f.get)
            REQUIRE(same_bits(f.get(a), f.get(b)));
        if (f.get_vector)
            REQUIRE(same_bits(f.get_vector(a), f.get_vector(b)));
    }
    for (std::size_t i = 0; i < a.simulation.colliders.size(); ++i)
        REQUIRE(same_bits(a.simulation.colliders[i], b.simulation.colliders[i]));
    for (std::size_t i = 0; i < a.simulation.stepping.accelerations.size(); ++i)
        REQUIRE(same_bits(a.simulation.stepping.accelerations[i], b.simulation.stepping.accelerations[i]));
}

} // namespace

TEST_CASE("Random scenes are read as they were written, to the last bit") {
    for (int seed = 0; seed < attempts(3000); ++seed) {
        INFO("seed " << seed);
        const scene::Scene written = RandomScene(static_cast<std::uint64_t>(seed)).scene();
        const std::string text = scene::write_scene(written);
        const scene::Scene read = scene::read_scene(text, "text");
        require_same(written, read);
        REQUIRE(scene::write_scene(read) == text);
    }
}

TEST_CASE("Random scenes are loaded from a file as they were saved, over an older one too") {
    const TemporaryFolder folder;
    const auto file = folder / "scene.json";
    for (int seed = 0; seed < attempts(300); ++seed) {
        scene::Scene saved = RandomScene(static_cast<std::uint64_t>(seed)).scene();
        if (saved.name.empty())
            saved.name = "scene"; // where there is none, loading takes the file's name
        scene::save_scene(saved, file);
        require_same(saved, scene::load_scene(file));
    }
    REQUIRE(files_of(folder.path()) == std::vector{file}); // nothing half-written is left behind
}

TEST_CASE("A scene without a name is called after its file") {
    const TemporaryFolder folder;
    scene::save_scene({}, folder / "silk.json");
    REQUIRE(scene::load_scene(folder / "silk.json").name == "silk");
}

TEST_CASE("A scene that differs from the default in every member is read as it was written") {
    RandomScene random(1);
    scene::Scene scene;
    const scene::Scene standard;
    for (const scene::Field& f : scene::fields()) {
        if (f.type == scene::FieldType::choice && f.choices.size() == 1)
            continue; // nothing else is built yet
        INFO(f.key);
        const auto differs = [&] {
            if (f.get_vector)
                return f.get_vector(scene) != f.get_vector(standard);
            return f.get_text ? f.get_text(scene) != f.get_text(standard) : f.get(scene) != f.get(standard);
        };
        for (int i = 0; i < 1000 && !differs(); ++i)
            random.set(scene, f);
        REQUIRE(differs());
    }
    scene.name = "n";
    scene.description = "d";
    scene.look.shaders = {{"diffuse", {{"front_colour", sim::Vec3{1, 0, 0.5}}}}};
    scene.simulation.cloth.pinned = {{1, 0}};
    scene.simulation.stepping.accelerations = {{1, 2, 3}};
    scene.simulation.colliders = {sim::Sphere{{1, 2, 3}, 4, 0.5}, sim::Plane{{6, 7, 8}, {9, 10, 11}, 0.75}};

    // When a member is added these bindings no longer compile: give it a line here, and a place in the file.
    const auto different = [](const auto&... pairs) { return ((pairs.first != pairs.second) && ...); };
    const auto pair = [](const auto& a, const auto& b) { return std::pair(a, b); };
    {
        const auto& [name, description, simulation, camera, look] = scene;
        const auto& [name0, description0, simulation0, camera0, look0] = standard;
        REQUIRE(different(pair(name, name0), pair(description, description0), pair(simulation, simulation0),
                          pair(camera, camera0), pair(look, look0)));
    }
    {
        const auto& [target, distance, yaw, pitch, fov, projection] = *scene.camera;
        const scene::Camera c;
        REQUIRE(different(pair(target, c.target), pair(distance, c.distance), pair(yaw, c.yaw), pair(pitch, c.pitch),
                          pair(fov, c.fov), pair(projection, c.projection)));
    }
    {
        const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s] = scene.look;
        const auto& [a0, b0, c0, d0, e0, f0, g0, h0, i0, j0, k0, l0, m0, n0, o0, p0, q0, r0, s0] = standard.look;
        REQUIRE(different(pair(a, a0), pair(b, b0), pair(c, c0), pair(d, d0), pair(e, e0), pair(f, f0), pair(g, g0),
                          pair(h, h0), pair(i, i0), pair(j, j0), pair(k, k0), pair(l, l0), pair(m, m0), pair(n, n0),
                          pair(o, o0), pair(p, p0), pair(q, q0), pair(r, r0), pair(s, s0)));
    }
    {
        const auto& [on, position, shader, latitude, longitude] = scene.look.split;
        const scene::SplitView v;
        REQUIRE(different(pair(on, v.on), pair(position, v.position), pair(shader, v.shader),
                          pair(latitude, v.sphere_latitude_lines), pair(longitude, v.sphere_longitude_lines)));
        const auto& [place, intensity] = scene.look.lamp;
        const auto& [second_place, second_intensity] = scene.look.second_lamp;
        REQUIRE(different(pair(place, standard.look.lamp.position), pair(intensity, standard.look.lamp.intensity),
                          pair(second_place, standard.look.second_lamp.position),
                          pair(second_intensity, standard.look.second_lamp.intensity)));
    }
    {
        const auto& [cloth, colliders, wind, rules, stepping] = scene.simulation;
        const sim::Description d;
        REQUIRE(different(pair(cloth, d.cloth), pair(colliders, d.colliders), pair(wind, d.wind), pair(rules, d.rules),
                          pair(stepping, d.stepping)));
    }
    {
        const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = scene.simulation.cloth;
        const auto& [a0, b0, c0, d0, e0, f0, g0, h0, i0, j0, k0, l0, m0, n0, o0] = standard.simulation.cloth;
        REQUIRE(different(pair(a, a0), pair(b, b0), pair(c, c0), pair(d, d0), pair(e, e0), pair(f, f0), pair(g, g0),
                          pair(h, h0), pair(i, i0), pair(j, j0), pair(k, k0), pair(l, l0), pair(m, m0), pair(n, n0),
                          pair(o, o0)));
    }
    {
        const auto& [integrator, precision, frames, substeps, iterations, tolerance, stiffness, damping, guess,
                     acceleration, seed, gravity, further] = scene.simulation.stepping;
        const sim::Stepping s;
        REQUIRE(different(pair(integrator, s.integrator), pair(precision, s.precision),
                          pair(frames, s.frames_per_second), pair(substeps, s.substeps), pair(iterations, s.iterations),
                          pair(tolerance, s.tolerance), pair(stiffness, s.pbd_stiffness),
                          pair(damping, s.spring_damping), pair(guess, s.first_guess),
                          pair(acceleration, s.acceleration), pair(seed, s.seed), pair(gravity, s.gravity),
                          pair(further, s.accelerations)));
    }
    {
        const auto& [kind, clock, velocity, gust, period, density, drag, lift] = scene.simulation.wind;
        const sim::Wind w;
        REQUIRE(different(pair(kind, w.kind), pair(clock, w.clock), pair(velocity, w.velocity), pair(gust, w.gust),
                          pair(period, w.gust_period), pair(density, w.air_density), pair(drag, w.drag),
                          pair(lift, w.lift)));
    }
    {
        const auto& [damping, start, limit, friction, plane, self_collision] = scene.simulation.rules;
        const sim::Rules r;
        REQUIRE(different(pair(damping, r.damping), pair(start, r.start), pair(limit, r.limit),
                          pair(friction, r.friction), pair(plane, r.plane), pair(self_collision, r.self_collision)));
    }
    require_same(scene, scene::read_scene(scene::write_scene(scene), "text"));
}

TEST_CASE("A scene that cannot be saved says so, and leaves the old file whole") {
    const TemporaryFolder folder;
    REQUIRE_THROWS_AS(scene::save_scene({}, folder / "no" / "such" / "folder.json"), scene::SceneError);
    REQUIRE_THROWS_AS(scene::save_scene({}, folder.path()), scene::SceneError);
    REQUIRE(std::filesystem::is_directory(folder.path()));
    REQUIRE(files_of(folder.path()).empty());
    // A file can be replaced by a scene, but a folder of the partial file's name is in the way.
    write_file(folder / "a.json", "old");
    std::filesystem::create_directory(folder / "a.json.part");
    REQUIRE_THROWS_AS(scene::save_scene({}, folder / "a.json"), scene::SceneError);
    REQUIRE(read_file(folder / "a.json") == "old");
}

TEST_CASE("A name that is not UTF-8, as a file may have, is saved with replacement characters") {
    scene::Scene scene;
    scene.name = "caf\xe9";
    REQUIRE(scene::read_scene(scene::write_scene(scene), "text").name == "caf\uFFFD");
}
