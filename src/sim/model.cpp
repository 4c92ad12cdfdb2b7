#include "sim/model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "sim/units.h"

namespace clothlab::sim {
namespace {

template <class Real>
std::variant<SphereModel<Real>, PlaneModel<Real>> collider_model(const Collider& collider) {
    const auto real = [](double v) { return static_cast<Real>(v); };
    if (const Sphere* s = std::get_if<Sphere>(&collider))
        return SphereModel<Real>{real(s->origin.x), real(s->origin.y),       real(s->origin.z),
                                 real(s->radius),   real(1.0 - s->friction), real(s->friction)};
    const Plane& p = std::get<Plane>(collider);
    // Scaled by its largest component first, so that no normal is too short or too long to be squared.
    Vec3 n = p.normal;
    const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
    if (!(largest > 0) || !std::isfinite(largest))
        throw std::invalid_argument("a plane needs a normal that is not zero");
    n = {n.x / largest, n.y / largest, n.z / largest};
    const double length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    return PlaneModel<Real>{real(p.point.x),    real(p.point.y),    real(p.point.z),        real(n.x / length),
                            real(n.y / length), real(n.z / length), real(1.0 - p.friction), real(p.friction)};
}

} // namespace

template <class Real>
Model<Real> make_model(const Description& description, std::shared_ptr<const Grid<Real>> grid) {
    const Cloth& cloth = description.cloth;
    const Stepping& stepping = description.stepping;
    if (cloth.density == 0 || !std::isfinite(cloth.density))
        throw std::invalid_argument("the density may be any number but zero");
    if (stepping.substeps < 1)
        throw std::invalid_argument("a frame needs at least one substep");
    if (!(stepping.frames_per_second > 0))
        throw std::invalid_argument("the frame rate must be above zero");

    const auto real = [](double v) { return static_cast<Real>(v); };
    Model<Real> model;
    model.k = {real(cloth.ks), real(cloth.ks), real(bending_share * cloth.ks)};
    model.grid = std::move(grid);
    model.pinned.assign(model.grid->points(), 0);
    for (const auto [column, row] : cloth.pinned) {
        if (column < 0 || column >= model.grid->columns || row < 0 || row >= model.grid->rows)
            throw std::invalid_argument("the pin [" + std::to_string(column) + ", " + std::to_string(row) +
                                        "] is outside the grid");
        model.pinned[static_cast<std::size_t>(row * model.grid->columns + column)] = 1;
    }
    for (std::uint32_t i = 0; i < model.pinned.size(); ++i)
        if (model.pinned[i])
            model.pins.push_back(i);
    model.enabled = {cloth.enable_structural, cloth.enable_shearing, cloth.enable_bending};

    Vec3 g = stepping.gravity;
    for (const Vec3& a : stepping.accelerations)
        g = {g.x + a.x, g.y + a.y, g.z + a.z};
    model.density = cloth.density;
    model.mass = real(point_mass(cloth));
    model.gx = real(g.x);
    model.gy = real(g.y);
    model.gz = real(g.z);
    model.dt = step_length(description);
    if (description.rules.damping == DampingRule::physical) {
        const double decay = cloth.damping_rate * model.dt;
        model.damping_rate = cloth.damping_rate;
        model.keep = real(std::exp(-decay));
        model.force_share = decay == 0 ? Real(1) : real(-std::expm1(-decay) / decay);
    } else {
        model.keep = model.course_keep = real(1.0 - fraction(cloth.damping));
    }
    model.substeps = stepping.substeps;
    model.thickness = real(cloth.thickness);
    const double w = 3.0 * cloth.width / cloth.num_width_points, h = 3.0 * cloth.height / cloth.num_height_points;
    model.cell_x = real(w);
    model.cell_y = real(h);
    model.cell_z = real(std::max(w, h));
    model.spacing_x = real(cloth.width / (cloth.num_width_points - 1));
    model.spacing_y = real(cloth.height / (cloth.num_height_points - 1));
    for (const Collider& c : description.colliders)
        model.colliders.push_back(collider_model<Real>(c));
    model.wind = description.wind;
    model.rules = description.rules;
    model.integrator = stepping.integrator;
    model.iterations = stepping.iterations;
    model.tolerance = stepping.tolerance;
    model.pbd_stiffness = real(stepping.pbd_stiffness);
    model.spring_damping = real(stepping.spring_damping);
    model.first_guess = stepping.first_guess;
    model.acceleration = stepping.acceleration;
    return model;
}

template Model<float> make_model<float>(const Description&, std::shared_ptr<const Grid<float>>);
template Model<double> make_model<double>(const Description&, std::shared_ptr<const Grid<double>>);

} // namespace clothlab::sim
