// The kinds of domains, and sets of kinds. They describe the domains on which a function or a
// setting is defined.
#pragma once

#include <cstdint>

namespace cascade {

enum class Domains : std::uint8_t {
    plane = 1,
    surface = 2,             ///< A grid on a surface given by a formula.
    grid = plane | surface,  ///< Cells are in rows and columns.
    model = 4,
    straight = plane | model,  ///< Axes are straight.
    bent = surface | model,
    fields = plane | surface | model,  ///< Cells have a fixed position.
    crawling = 8,                      ///< Cells of a `cells` system, which move on any domain.
    all = fields | crawling,
};
constexpr bool includes(Domains set, Domains one) {
    return (static_cast<unsigned>(set) & static_cast<unsigned>(one)) != 0;
}

}  // namespace cascade
