// Looking for infinities and NaNs in fields.
#include "solvers/finite.h"

#include <cstring>

namespace cascade {
namespace {

/// A number is infinite or NaN when all bits of its exponent are set; adding one to the exponent
/// then carries into the sign. Integer operations only, and no branch: it vectorises everywhere,
/// and no compiler flag can take it away.
bool row_is_finite(const float* row, std::int64_t width) {
    std::uint32_t carried = 0;
    for (std::int64_t i = 0; i < width; ++i) {
        std::uint32_t word;
        std::memcpy(&word, row + i, sizeof word);
        carried |= (word & 0x7fffffffu) + 0x00800000u;
    }
    return (carried & 0x80000000u) == 0;
}

}  // namespace

bool rows_are_finite(const Field& field, RowRange rows) {
    for (std::int64_t j = rows.begin; j < rows.end; ++j) {
        if (!row_is_finite(field.row(j), field.layout().width)) return false;
    }
    return true;
}

std::optional<CellPlace> first_not_finite(const Field& field) {
    const PlaneLayout& layout = field.layout();
    for (std::int64_t row = 0; row < layout.row_count(); ++row) {
        if (row_is_finite(field.row(row), layout.width)) continue;
        std::int64_t column = 0;
        while (row_is_finite(field.row(row) + column, 1)) ++column;
        return CellPlace{column, row % layout.height, row / layout.height};
    }
    return std::nullopt;
}

}  // namespace cascade
