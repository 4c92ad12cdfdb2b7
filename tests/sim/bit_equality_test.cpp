// The simulation against an independent implementation of docs/simulation.md: every coordinate of every point after
// each of ten frames, in both precisions. Every scene says which stage has to have acted in it.
#include <catch2/generators/catch_generators.hpp>
#include <catch2/generators/catch_generators_range.hpp>

#include "support/side_by_side.h"

using namespace clothlab;
using namespace clothlab::test;
using reference::Collider;
using reference::Parameters;
using sim::StepCounts;

namespace {

Parameters small_cloth() {
    Parameters p;
    p.columns = p.rows = 10;
    p.pinned = {{0, 0}, {9, 0}};
    return p;
}

Collider sphere(reference::Vector3 origin, double radius, double friction) {
    return {.is_sphere = true, .place = origin, .normal = {}, .radius = radius, .friction = friction};
}
Collider plane(reference::Vector3 point, reference::Vector3 normal, double friction) {
    return {.is_sphere = false, .place = point, .normal = normal, .radius = 0, .friction = friction};
}

const auto whatever = [](const StepCounts&) { return true; };
const auto touches_colliders = [](const StepCounts& sum) { return sum.contacts > 20; };
const auto touches_itself = [](const StepCounts& sum) { return sum.self_contacts > 100; };
const auto limits_stretch = [](const StepCounts& sum) { return sum.shortened_springs > 100; };

} // namespace

TEST_CASE("The course's default cloth on two pins equals the reference to the last bit") {
    Parameters p;
    p.pinned = {{0, 0}, {49, 0}};
    require_same_bits(p, whatever);
}

TEST_CASE("Every set of spring kinds equals the reference to the last bit in either orientation, pinned or not") {
    const int set = GENERATE(range(0, 8));
    Parameters p = small_cloth();
    p.structural = (set & 1) != 0;
    p.shear = (set & 2) != 0;
    p.bending = (set & 4) != 0;
    p.vertical = GENERATE(false, true);
    p.seed = p.vertical ? 7 : 0;
    if (GENERATE(false, true))
        p.pinned.clear();
    require_same_bits(p, whatever);
}

TEST_CASE("A cloth that falls on a sphere equals the reference to the last bit") {
    Parameters p = small_cloth();
    p.pinned.clear();
    p.colliders = {sphere({0.5, 0.79, 0.47}, 0.2, GENERATE(0.0, 0.3, 1.0))}; // its top is 10 mm below the cloth
    require_same_bits(p, touches_colliders);
}

TEST_CASE("A cloth that starts inside a sphere equals the reference to the last bit") {
    Parameters p = small_cloth();
    p.vertical = GENERATE(false, true);
    p.colliders = {p.vertical ? sphere({0.5, 0.5, 0.05}, 0.2, 0.1) : sphere({0.5, 0.9, 0.5}, 0.2, 0.1)};
    require_same_bits(p, touches_colliders);
}

TEST_CASE("A cloth that falls on a plane equals the reference to the last bit") {
    Parameters p = small_cloth();
    p.pinned.clear();
    const double friction = GENERATE(0.0, 0.5, 1.0);
    p.colliders = {plane({0.5, 0.98, 0.5}, {0.01, 2.5, -0.02}, friction)};
    require_same_bits(p, touches_colliders);
}

TEST_CASE("A plane that is reached from its back equals the reference to the last bit") {
    Parameters p = small_cloth();
    p.pinned.clear();
    if (GENERATE(false, true)) {
        p.gravity = {0, 9.8, 0};
        p.colliders = {plane({0, 1.02, 0}, {0.02, 1, 0.01}, 0.3)}; // the cloth rises from below
    } else {
        p.colliders = {plane({0, 0.97, 0}, {0.02, -1, 0.01}, 0.3)}; // the plane looks down
    }
    require_same_bits(p, touches_colliders);
}

TEST_CASE("Several colliders equal the reference to the last bit in the scene's order") {
    Parameters p = small_cloth();
    p.pinned.clear();
    p.colliders = {sphere({0.3, 0.9, 0.3}, 0.15, 0.3), plane({0, 0.97, 0}, {0, 1, 0.01}, 0.4),
                   sphere({0.4, 0.9, 0.4}, 0.15, 0.1), plane({0.95, 0, 0}, {-1, 0.1, 0}, 0.2)};
    require_same_bits(p, touches_colliders);
    std::swap(p.colliders[0], p.colliders[1]);
    require_same_bits(p, touches_colliders);
}

TEST_CASE("Self-collision equals the reference to the last bit") {
    Parameters p = small_cloth();
    p.vertical = GENERATE(false, true);
    p.thickness = 0.08; // neighbours are 0.11 m apart
    if (GENERATE(false, true))
        p.offset = {-0.53, -0.61, -0.4};
    require_same_bits(p, touches_itself);
}

TEST_CASE("A standing cloth that folds up on a plane equals the reference to the last bit") {
    Parameters p = small_cloth();
    p.columns = 12;
    p.rows = 15;
    p.pinned.clear();
    p.vertical = true;
    p.thickness = 0.03;
    p.offset = {-0.5, 0.02, 0};
    p.ks = 200;
    p.seed = 3;
    p.colliders = {plane({0, 0, 0}, {0, 1, 0}, 0.5)};
    const auto folds = [](const StepCounts& sum) { return sum.contacts > 100 && sum.self_contacts > 100; };
    require_same_bits(p, folds, 60);
}

TEST_CASE("An active stretch limit equals the reference to the last bit, and so does none") {
    Parameters p = small_cloth();
    p.ks = 20;
    p.further_accelerations = {{0, -20, 0}};
    SECTION("all springs on") {
        require_same_bits(p, limits_stretch);
    }
    SECTION("the limit sweeps springs that are switched off, too") {
        p.structural = false;
        p.bending = false;
        require_same_bits(p, limits_stretch);
    }
    SECTION("springs between two pins cannot be shortened") {
        p.pinned = {{0, 0}, {1, 0}, {2, 0}, {9, 0}};
        require_same_bits(p, limits_stretch);
    }
    SECTION("off") {
        p.stretch_limit = false;
        require_same_bits(p, [](const StepCounts& sum) { return sum.shortened_springs == 0; });
    }
}

TEST_CASE("All stages together equal the reference to the last bit") {
    Parameters p = small_cloth();
    p.ks = 60;
    p.thickness = 0.07;
    p.colliders = {sphere({0.5, 0.85, 0.5}, 0.2, 0.3), plane({0, 0.98, 0}, {0.1, 1, 0}, 0.2)};
    p.wind = reference::Wind::course_with_step;
    require_same_bits(p, [](const StepCounts& sum) {
        return sum.contacts > 20 && sum.self_contacts > 100 && sum.shortened_springs > 100;
    });
}

TEST_CASE("Further accelerations, other grids, offsets, step lengths and masses equal the reference to the last bit") {
    Parameters p = small_cloth();
    SECTION("further accelerations are added in order") {
        p.gravity = {0.1, -9.7, 0.3};
        p.further_accelerations = {{0.7, 0.1, -2.3}, {1e-3, 5, 0.9}};
    }
    SECTION("7 x 13 points on 0.6 m x 1.7 m") {
        p.columns = 7;
        p.rows = 13;
        p.width = 0.6;
        p.height = 1.7;
        p.pinned = {{6, 0}, {0, 12}};
        p.vertical = GENERATE(false, true);
    }
    SECTION("13 x 7 points with self-collision") {
        p.columns = 13;
        p.rows = 7;
        p.width = 0.7;
        p.pinned = {{6, 3}};
        p.thickness = 0.05;
    }
    SECTION("the smallest cloth") {
        p.columns = p.rows = 2;
        p.pinned = {{0, 0}};
    }
    SECTION("an offset") {
        p.offset = {-3.3, 0.7, 12.1};
    }
    SECTION("60 frames/s of 7 substeps") {
        p.frames_per_second = 60;
        p.substeps = 7;
        p.ks = 500;
    }
    SECTION("23.976 frames/s of 64 substeps") {
        p.frames_per_second = 23.976;
        p.substeps = 64;
    }
    SECTION("a negative density") {
        p.density = -150;
    }
    SECTION("a heavy and strongly damped cloth") {
        p.density = 4000;
        p.damping_percent = 3.7;
    }
    SECTION("a seed above 2^32") {
        p.vertical = true;
        p.seed = 9007199254740991u;
    }
    require_same_bits(p, whatever);
}
