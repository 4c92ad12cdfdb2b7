#include "sim/implicit/spring_hessian.h"

#include <algorithm>
#include <cmath>

namespace clothlab::sim {
namespace {

/// How far before a point its neighbour of a stencil entry lies.
template <class Real>
std::size_t distance(const Model<Real>& model, std::size_t s) {
    const SpringStencil& spring = spring_stencil[s];
    return static_cast<std::size_t>(-spring.rows * model.grid->columns - spring.columns);
}

template <class Real>
void compute_blocks(const Model<Real>& model, const Vec3Array<Real>& x, std::size_t begin, std::size_t end,
                    SpringHessian<Real>& hessian) {
    const Grid<Real>& grid = *model.grid;
    const auto columns = static_cast<std::size_t>(grid.columns);
    for (std::size_t s = 0; s < stencil_size; ++s) {
        auto& [t, wx, wy, wz] = hessian.springs[s];
        if (!model.pulls(s))
            continue; // zero from the start
        const int step = spring_stencil[s].columns;
        const std::size_t back = distance(model, s);
        const Real k = model.spring_constant(s);
        for (std::size_t i = std::max(begin, static_cast<std::size_t>(-spring_stencil[s].rows) * columns); i < end;
             ++i) {
            const int to_column = static_cast<int>(i % columns) + step;
            if (to_column < 0 || to_column >= grid.columns)
                continue;
            const std::size_t b = i - back;
            const Real dx = x.x[b] - x.x[i], dy = x.y[b] - x.y[i], dz = x.z[b] - x.z[i];
            const Real length = std::sqrt(dx * dx + dy * dy + dz * dz);
            // A spring of length zero has no direction and pulls nowhere: as the forces have it.
            const Real across = length > 0 ? std::max(Real(0), Real(1) - grid.rest_length(s, i) / length) : Real(0);
            const Real along = length > 0 ? std::sqrt(k * (Real(1) - across)) / length : Real(0);
            t[i] = k * across;
            wx[i] = along * dx;
            wy[i] = along * dy;
            wz[i] = along * dz;
        }
    }
}

template <class Real>
void invert_diagonal(const Model<Real>& model, Real a, std::size_t begin, std::size_t end,
                     SpringHessian<Real>& hessian) {
    const std::size_t points = model.grid->points();
    for (std::size_t i = begin; i < end; ++i) {
        Real xx = a, xy = 0, xz = 0, yy = a, yz = 0, zz = a;
        const auto add = [&](const typename SpringHessian<Real>::Blocks& b, std::size_t owner) {
            xx += b.t[owner] + b.wx[owner] * b.wx[owner];
            xy += b.wx[owner] * b.wy[owner];
            xz += b.wx[owner] * b.wz[owner];
            yy += b.t[owner] + b.wy[owner] * b.wy[owner];
            yz += b.wy[owner] * b.wz[owner];
            zz += b.t[owner] + b.wz[owner] * b.wz[owner];
        };
        for (std::size_t s = 0; s < stencil_size; ++s) {
            add(hessian.springs[s], i);
            if (const std::size_t owner = i + distance(model, s); owner < points)
                add(hessian.springs[s], owner);
        }
        const Real cxx = yy * zz - yz * yz, cxy = xz * yz - xy * zz, cxz = xy * yz - xz * yy;
        const Real determinant = xx * cxx + xy * cxy + xz * cxz;
        auto& inverse = hessian.inverse_diagonal;
        inverse[0][i] = cxx / determinant;
        inverse[1][i] = cxy / determinant;
        inverse[2][i] = cxz / determinant;
        inverse[3][i] = (xx * zz - xz * xz) / determinant;
        inverse[4][i] = (xy * xz - xx * yz) / determinant;
        inverse[5][i] = (xx * yy - xy * xy) / determinant;
    }
}

} // namespace

template <class Real>
void SpringHessian<Real>::resize(std::size_t points) {
    for (Blocks& b : springs)
        for (AlignedVector<Real>* v : {&b.t, &b.wx, &b.wy, &b.wz})
            v->assign(points, Real(0));
    for (AlignedVector<Real>& v : inverse_diagonal)
        v.resize(points);
}

template <class Real>
std::size_t SpringHessian<Real>::bytes() const {
    return (4 * springs.size() + inverse_diagonal.size()) * springs[0].t.capacity() * sizeof(Real);
}

template <class Real>
void linearise(const Model<Real>& model, const Vec3Array<Real>& position, Real a, Workspace<Real>& work,
               SpringHessian<Real>& hessian) {
    for_ranges(model, work,
               [&](int, std::size_t begin, std::size_t end) { compute_blocks(model, position, begin, end, hessian); });
    for_ranges(model, work,
               [&](int, std::size_t begin, std::size_t end) { invert_diagonal(model, a, begin, end, hessian); });
}

template <class Real>
void multiply(const Model<Real>& model, const SpringHessian<Real>& hessian, Real a, const Vec3Array<Real>& p,
              std::size_t begin, std::size_t end, Vec3Array<Real>& out) {
    const Real* __restrict px = p.x.data(), * __restrict py = p.y.data(), * __restrict pz = p.z.data();
    Real* __restrict ox = out.x.data(), * __restrict oy = out.y.data(), * __restrict oz = out.z.data();
    for (std::size_t i = begin; i < end; ++i) {
        ox[i] = a * px[i];
        oy[i] = a * py[i];
        oz[i] = a * pz[i];
    }
    // By stencil entry, and in it each point's own spring before the one that ends at it, which a later point owns: so
    // every point's sum has the same order, wherever its range begins. Springs between ranges are computed in both.
    constexpr std::size_t block = 256; // forces of so many springs stay in the first-level cache
    alignas(64) Real fx[block], fy[block], fz[block];
    for (std::size_t s = 0; s < stencil_size; ++s) {
        if (!model.pulls(s))
            continue;
        const std::size_t back = distance(model, s);
        const std::size_t first = std::max(begin, back), last = std::min(end + back, p.size());
        const auto& blocks = hessian.springs[s];
        const Real *__restrict t = blocks.t.data(), *__restrict wx = blocks.wx.data(), *__restrict wy = blocks.wy.data(),
                               *__restrict wz = blocks.wz.data();
        for (std::size_t from = first; from < last; from += block) {
            const std::size_t count = std::min(block, last - from);
            for (std::size_t n = 0; n < count; ++n) {
                const std::size_t i = from + n;
                const Real dx = px[i] - px[i - back], dy = py[i] - py[i - back], dz = pz[i] - pz[i - back];
                const Real along = wx[i] * dx + wy[i] * dy + wz[i] * dz;
                fx[n] = t[i] * dx + along * wx[i];
                fy[n] = t[i] * dy + along * wy[i];
                fz[n] = t[i] * dz + along * wz[i];
            }
            const std::size_t own = std::min(from + count, end);
            for (std::size_t i = from; i < own; ++i) {
                ox[i] += fx[i - from];
                oy[i] += fy[i - from];
                oz[i] += fz[i - from];
            }
            for (std::size_t i = std::max(from, begin + back); i < from + count; ++i) {
                ox[i - back] -= fx[i - from];
                oy[i - back] -= fy[i - from];
                oz[i - back] -= fz[i - from];
            }
        }
    }
    for (const std::uint32_t pin : model.pins)
        if (pin >= begin && pin < end)
            ox[pin] = oy[pin] = oz[pin] = 0;
}

#define CLOTHLAB_DEFINE(Real)                                                                                          \
    template struct SpringHessian<Real>;                                                                               \
    template void linearise<Real>(const Model<Real>&, const Vec3Array<Real>&, Real, Workspace<Real>&,                  \
                                  SpringHessian<Real>&);                                                               \
    template void multiply<Real>(const Model<Real>&, const SpringHessian<Real>&, Real, const Vec3Array<Real>&,         \
                                 std::size_t, std::size_t, Vec3Array<Real>&);
CLOTHLAB_DEFINE(float)
CLOTHLAB_DEFINE(double)
#undef CLOTHLAB_DEFINE

} // namespace clothlab::sim
