// The kinds of domains, and sets of kinds. A set says on which domains a function or a setting is
// defined.
#pragma once

#include <cstdint>

namespace cascade {

enum class Domains : std::uint8_t {
    plane = 1,
    surface = 2,             ///< Grids on a surface given by a formula.
    grid = plane | surface,  ///< Domains whose cells are in rows and columns.
    model = 4,
    straight = plane | model,  ///< Domains whose axes are straight.
    bent = surface | model,
    fields = plane | surface | model,  ///< Domains whose cells have a fixed position.
    crawling = 8,                      ///< Systems of moving cells (`cells`), on any domain.
    all = fields | crawling,
};
constexpr bool includes(Domains set, Domains one) {
    return (static_cast<unsigned>(set) & static_cast<unsigned>(one)) != 0;
}

}  // namespace cascade
