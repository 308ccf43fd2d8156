// Fills the halo of the mask according to the grid's boundary, and then collects the bits of
// neighbours.
#include "run/domain/domain_mask.h"

#include "core/counted_cells.h"
#include "ir/word_format.h"

#include <cmath>
#include <cstring>

namespace cascade {

namespace {

/// Returns the bits of the cell (i, j, k) and of the 26 cells around it.
std::uint32_t bits_around(const Plane<float>& inside, std::int64_t i, std::int64_t j,
                          std::int64_t k) {
    const std::int64_t reach = inside.layout().has_halo_slices() ? 1 : 0;
    std::uint32_t bits = 0;
    for (std::int64_t dz = -reach; dz <= reach; ++dz) {
        for (std::int64_t dy = -1; dy <= 1; ++dy) {
            for (std::int64_t dx = -1; dx <= 1; ++dx) {
                if (inside.at(i + dx, j + dy, k + dz) == 0) continue;
                bits |= std::uint32_t{1} << (dx + 1 + 3 * (dy + 1) + 9 * (dz + 1));
            }
        }
    }
    return bits;
}

}  // namespace

DomainMask make_domain_mask(const Field& values, const Grid& grid) {
    const PlaneLayout& layout = values.layout();
    DomainMask mask;
    mask.inside = Mask(layout);
    mask.neighbourhood = Field(layout, values.precision());
    Plane<float> inside(layout);
    values.visit([&](const auto& plane) {
        for_each_cell(
            [&](auto value, float& as_number, std::uint8_t& as_mask) {
                as_mask = std::isnormal(value) || std::isinf(value) ? 1 : 0;
                as_number = as_mask;
                mask.cells += as_mask;
            },
            plane, inside, mask.inside);
    });
    fill_halo(inside.origin(), layout, grid.boundary);
    mask.neighbourhood.visit([&]<typename Number>(Plane<Number>& words) {
        for (std::int64_t row = 0; row < layout.row_count(); ++row) {
            const std::int64_t j = row % layout.height, k = row / layout.height;
            for (std::int64_t i = 0; i < layout.width; ++i) {
                const WordOf<Number> bits = bits_around(inside, i, j, k);
                std::memcpy(words.row(row) + i, &bits, sizeof bits);
            }
        }
    });
    return mask;
}

Mask still_cells(const DomainMask& mask, const Mask* frozen) {
    const PlaneLayout& layout = mask.inside.layout();
    Mask still(layout);
    for (std::int64_t row = 0; row < layout.row_count(); ++row) {
        for (std::int64_t i = 0; i < layout.width; ++i) {
            const bool is_frozen = frozen != nullptr && frozen->row(row)[i] != 0;
            still.row(row)[i] = is_frozen || mask.inside.row(row)[i] == 0 ? 1 : 0;
        }
    }
    return still;
}

Field with_outside(const Field& field, const DomainMask& mask, float value) {
    Field copy = field.clone();
    copy.visit([&](auto& plane) {
        for_each_cell(
            [&](auto& cell, bool is_inside) {
                if (!is_inside) cell = value;
            },
            plane, mask.inside);
    });
    return copy;
}

}  // namespace cascade
