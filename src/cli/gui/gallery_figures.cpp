#include "cli/gui/gallery_figures.h"

namespace clothlab::cli {

const std::vector<Section>& gallery_sections() {
    static const std::vector<Section> sections{
        {"Springs",
         "Structural springs (blue) join neighbours, shear springs (orange) the diagonals, bending springs (pink) every "
         "second point along rows and columns.",
         {"look.shader=wireframe", "camera.target=0.5,0.98,0.5", "camera.distance=1.35", "camera.pitch=38",
          "camera.yaw=30", "cloth.num_width_points=25", "cloth.num_height_points=25", "cloth.pinned=[[0,0],[24,0]]"},
         {
             {"springs-all", "All springs", "two-pins", 0, {}},
             {"springs-no-shear", "Without shear springs", "two-pins", 0, {"cloth.enable_shearing=false", "look.show_shearing=false"}},
             {"springs-shear-only", "Shear springs only", "two-pins", 0, {"look.show_structural=false", "look.show_bending=false"}},
             {"springs-all-close", "All springs, near a pin", "two-pins", 0, {"camera.target=0.12,1,0.12", "camera.distance=0.4"}},
             {"springs-no-shear-close", "Without shear springs, near a pin", "two-pins", 0, {"cloth.enable_shearing=false", "look.show_shearing=false", "camera.target=0.12,1,0.12", "camera.distance=0.4"}},
             {"springs-shear-only-close", "Shear springs only, near a pin", "two-pins", 0, {"look.show_structural=false", "look.show_bending=false", "camera.target=0.12,1,0.12", "camera.distance=0.4"}},
         }},
        {"Stiffness ks",
         "The cloth of two pins after three seconds. Soft springs let it sag until the stretch limit holds it; "
         "stiff ones keep its shape, until they are too stiff for the step.",
         {"look.shader=wireframe", "camera.target=0.5,0.5,0.1", "camera.distance=1.5"},
         {
             {"ks-5", "ks 5 N/m", "two-pins", 270, {"cloth.ks=5"}},
             {"ks-500", "ks 500 N/m", "two-pins", 270, {"cloth.ks=500"}},
             {"ks-5000", "ks 5 000 N/m", "two-pins", 270, {"cloth.ks=5000"}},
             {"ks-50000", "ks 50 000 N/m", "two-pins", 270, {"cloth.ks=50000"}},
             {"ks-100000", "ks 100 000 N/m", "two-pins", 270, {"cloth.ks=100000"}},
             {"ks-300000", "ks 300 000 N/m", "two-pins", 60, {"cloth.ks=300000"}},
             {"ks-1000000", "ks 1 000 000 N/m", "two-pins", 1, {"cloth.ks=1000000"}},
         }},
        {"Density",
         "Heavier cloth stretches like softer cloth: what counts is ks over mass.",
         {"look.shader=wireframe", "camera.target=0.5,0.5,0.1", "camera.distance=1.5"},
         {
             {"density-1", "Density 1 g/cm²", "two-pins", 270, {"cloth.density=10"}},
             {"density-15", "Density 15 g/cm²", "two-pins", 270, {"cloth.density=150"}},
             {"density-30", "Density 30 g/cm²", "two-pins", 270, {"cloth.density=300"}},
             {"density-100000", "Density 100 000 g/cm²", "two-pins", 270, {"cloth.density=1000000"}},
             {"density-negative", "Density -15 g/cm²", "two-pins", 30, {"cloth.density=-150"}},
         }},
        {"Damping",
         "The same moments of the fall with different damping: without any, the cloth swings through and goes on "
         "swinging; with 1 % lost in each of the 2700 steps a second, it sinks as if in honey.",
         {"look.shader=wireframe", "camera.target=0.5,0.6,0.2", "camera.distance=1.75"},
         {
             {"damping-0-early", "Damping 0 %, after 0.5 s", "two-pins", 45, {"cloth.damping=0"}},
             {"damping-0.2-early", "Damping 0.2 %, after 0.5 s", "two-pins", 45, {"cloth.damping=0.2"}},
             {"damping-1-early", "Damping 1 %, after 0.5 s", "two-pins", 45, {"cloth.damping=1"}},
             {"damping-0-late", "Damping 0 %, after 3 s", "two-pins", 270, {"cloth.damping=0"}},
             {"damping-0.2-late", "Damping 0.2 %, after 3 s", "two-pins", 270, {"cloth.damping=0.2"}},
             {"damping-1-late", "Damping 1 %, after 3 s", "two-pins", 270, {"cloth.damping=1"}},
         }},
        {"Four pins", "The cloth of the course's pinned4 scene, come to rest.",
         {"camera.target=0.5,0.85,0.5", "camera.distance=1.55"},
         {
             {"pinned4", "Shaded", "four-pins", 270, {}},
             {"pinned4-wireframe", "Wireframe", "four-pins", 270, {"look.shader=wireframe"}},
         }},
        {"Over a sphere", "The same cloth over the same sphere, with springs a hundred times stiffer from first to last.",
         {"camera.target=0.5,0.22,0.5", "camera.distance=1.25", "camera.pitch=22"},
         {
             {"sphere-500", "ks 500 N/m", "sphere-soft", 270, {}},
             {"sphere-5000", "ks 5 000 N/m", "sphere-medium", 270, {}},
             {"sphere-50000", "ks 50 000 N/m", "sphere-stiff", 270, {}},
         }},
        {"On a plane", "The cloth has fallen flat and lies.",
         {"camera.target=0.5,0,0.5", "camera.distance=1.7"},
         {
             {"plane-rest", "At rest on the plane", "plane", 180, {}},
         }},
        {"Falling on itself", "An upright cloth falls, folds, and comes to rest on itself.",
         {"camera.target=0.5,0.25,0.05", "camera.distance=1.6"},
         {
             {"self-early", "First folds", "self-collision", 45, {}},
             {"self-middle", "Folding over", "self-collision", 85, {}},
             {"self-rest", "At rest", "self-collision", 360, {}},
         }},
        {"Falling on itself: stiffness", "Three stages each: soft cloth makes many fine folds, stiff cloth few wide ones.",
         {"camera.target=0.5,0.25,0.05", "camera.distance=1.6"},
         {
#define STAGES(name, title, setting)                                                                                   \
    {name "-early", title ", first folds", "self-collision", 45, {setting}},                                           \
        {name "-middle", title ", folding over", "self-collision", 85, {setting}}, {                                   \
        name "-rest", title ", at rest", "self-collision", 360, { setting }                                            \
    }
             STAGES("self-ks-1000", "ks 1 000 N/m", "cloth.ks=1000"),
             STAGES("self-ks-5000", "ks 5 000 N/m", "cloth.ks=5000"),
             STAGES("self-ks-7500", "ks 7 500 N/m", "cloth.ks=7500"),
             STAGES("self-ks-10000", "ks 10 000 N/m", "cloth.ks=10000"),
         }},
        {"Falling on itself: density", "Three stages each: heavy cloth collapses as soft cloth does.",
         {"camera.target=0.5,0.25,0.05", "camera.distance=1.6"},
         {
             STAGES("self-density-1", "Density 1 g/cm²", "cloth.density=10"),
             STAGES("self-density-15", "Density 15 g/cm²", "cloth.density=150"),
             STAGES("self-density-50", "Density 50 g/cm²", "cloth.density=500"),
#undef STAGES
         }},
        {"Wind", "The formula of one course solution, and drag and lift on every triangle.",
         {},
         {
             {"wind-course-1", "Course wind, after 1 s", "wind-course", 90, {}},
             {"wind-course-2", "Course wind, after 2 s", "wind-course", 180, {}},
             {"wind-flag-1", "Flag, after 1.5 s", "flag", 135, {}},
             {"wind-flag-2", "Flag, after 3 s", "flag", 270, {}},
         }},
    };
    return sections;
}

} // namespace clothlab::cli
