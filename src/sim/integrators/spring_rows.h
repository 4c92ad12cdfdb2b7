// Springs in an order in which neighbours in the order have no points in common: row by row, kind by kind, and within
// a row every second horizontal spring first. So compilers make vectors of loops over them, and processors need not
// wait for one spring's points before they begin with the next one's.
#pragma once

#include <cstdlib>
#include <type_traits>

#include "sim/model.h"

namespace clothlab::sim {

/// Springs of one stencil entry in one row; the first one's ends are a, its owner, and b, the next ones' are `stride`
/// further. No two of them have a point in common.
struct SpringRow {
    std::size_t a, b, count;
    std::size_t s; ///< the entry in the stencil
};

/// Calls visit(row, stride) for all springs that pull; the stride is a constant, a std::integral_constant.
template <class Real, class Visit>
void for_each_spring_row(const Model<Real>& model, Visit visit) {
    const auto columns = static_cast<std::size_t>(model.grid->columns);
    for (int row = 0; row < model.grid->rows; ++row) {
        const std::size_t begin = static_cast<std::size_t>(row) * columns;
        for (std::size_t s = 0; s < stencil_size; ++s) {
            const SpringStencil& stencil = spring_stencil[s];
            const auto across = static_cast<std::size_t>(std::abs(stencil.columns));
            const auto up = static_cast<std::size_t>(-stencil.rows);
            if (!model.pulls(s) || row + stencil.rows < 0 || columns <= across)
                continue;
            if (up != 0) {
                const std::size_t a = begin + (stencil.columns < 0 ? across : 0);
                const std::size_t b = begin - up * columns + (stencil.columns > 0 ? across : 0);
                visit(SpringRow{a, b, columns - across, s}, std::integral_constant<std::size_t, 1>());
                continue;
            }
            // Within the row: springs that begin 2 `across` apart have no points in common.
            for (std::size_t first = 0; first < 2 * across && first + across < columns; ++first) {
                const std::size_t b = begin + first, stride = 2 * across;
                const SpringRow springs{b + across, b, (columns - across - first + stride - 1) / stride, s};
                if (across == 1)
                    visit(springs, std::integral_constant<std::size_t, 2>());
                else
                    visit(springs, std::integral_constant<std::size_t, 4>());
            }
        }
    }
}

} // namespace clothlab::sim
