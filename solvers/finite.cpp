// Looking for infinities and NaNs in fields.
#include "solvers/finite.h"

#include <cstring>

namespace cascade {
namespace {

/// A number is infinite or NaN when all bits of its exponent are set; adding one to the exponent
/// then carries into the sign. Integer operations only, and no branch: it vectorises everywhere,
/// and no compiler flag can take it away.
template <typename Number, typename Word>
bool row_is_finite_in(const Number* row, std::int64_t width, Word sign, Word exponent_one) {
    Word carried = 0;
    for (std::int64_t i = 0; i < width; ++i) {
        Word word;
        std::memcpy(&word, row + i, sizeof word);
        carried |= (word & ~sign) + exponent_one;
    }
    return (carried & sign) == 0;
}

bool row_is_finite(const float* row, std::int64_t width) {
    return row_is_finite_in(row, width, std::uint32_t{1} << 31, std::uint32_t{1} << 23);
}

bool row_is_finite(const double* row, std::int64_t width) {
    return row_is_finite_in(row, width, std::uint64_t{1} << 63, std::uint64_t{1} << 52);
}

}  // namespace

bool rows_are_finite(const Field& field, RowRange rows) {
    return field.visit([&](const auto& plane) {
        for (std::int64_t j = rows.begin; j < rows.end; ++j) {
            if (!row_is_finite(plane.row(j), plane.layout().width)) return false;
        }
        return true;
    });
}

std::optional<CellPlace> first_not_finite(const Field& field) {
    return field.visit([](const auto& plane) -> std::optional<CellPlace> {
        const PlaneLayout& layout = plane.layout();
        for (std::int64_t row = 0; row < layout.row_count(); ++row) {
            if (row_is_finite(plane.row(row), layout.width)) continue;
            std::int64_t column = 0;
            while (row_is_finite(plane.row(row) + column, 1)) ++column;
            return CellPlace{column, row % layout.height, row / layout.height};
        }
        return std::nullopt;
    });
}

}  // namespace cascade
