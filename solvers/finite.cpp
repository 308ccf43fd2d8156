// Finds infinities and NaNs in fields.
#include "solvers/finite.h"

#include "core/wide_vectors.h"

#include <cstring>
#include <iterator>

namespace cascade {
namespace {

/// A number is infinite or NaN if all bits of its exponent are set. Adding one to the exponent then
/// carries into the sign. Integer operations without branches are vectorised on all machines, and
/// no compiler flag can remove them.
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

namespace {

/// Sums of several numbers at a time: one vector of the widest kind, or a few narrower vectors.
template <typename Number>
struct Lanes {
    typedef Number Vector [[gnu::vector_size(64)]];
    static constexpr std::int64_t count = 64 / sizeof(Number);
    /// `even` and `odd` are independent sums, so the processor can compute both at the same time.
    Vector even{}, odd{}, last{};
};

template <typename Number>
inline void add_row(const Number* row, std::int64_t width, Lanes<Number>& sums) {
    using Vector = typename Lanes<Number>::Vector;
    constexpr std::int64_t lanes = Lanes<Number>::count;
    Vector even = sums.even, odd = sums.odd;
    std::int64_t i = 0;
    for (; i + 2 * lanes <= width; i += 2 * lanes) {
        Vector first, second;
        std::memcpy(&first, row + i, sizeof first);
        std::memcpy(&second, row + i + lanes, sizeof second);
        even += first;
        odd += second;
    }
    sums.even = even;
    sums.odd = odd;
    for (; i < width; ++i) sums.last[i % lanes] += row[i];
}

WITH_WIDE_VECTORS void add_rows(const Plane<float>& plane, RowRange rows, ColumnRange columns,
                                Lanes<float>& sums) {
    for (std::int64_t row = rows.begin; row < rows.end; ++row)
        add_row(plane.row(row) + columns.begin, columns.count(), sums);
}

WITH_WIDE_VECTORS void add_rows(const Plane<double>& plane, RowRange rows, ColumnRange columns,
                                Lanes<double>& sums) {
    for (std::int64_t row = rows.begin; row < rows.end; ++row)
        add_row(plane.row(row) + columns.begin, columns.count(), sums);
}

}  // namespace

bool are_finite(const Field& field, const Patch& cells) {
    const ColumnRange columns = cells.columns.within(field.layout().width);
    return field.visit([&]<typename Number>(const Plane<Number>& plane) {
        // If a sum has an infinite or NaN term, the sum cannot become finite again. A sum of finite
        // terms may overflow, too, so the values of a row whose sum is not finite are checked one
        // by one.
        Lanes<Number> sums{};
        add_rows(plane, cells.rows, columns, sums);
        Number all[3 * Lanes<Number>::count];
        std::memcpy(all, &sums, sizeof all);
        if (row_is_finite(all, std::ssize(all))) return true;
        for (std::int64_t j = cells.rows.begin; j < cells.rows.end; ++j) {
            if (!row_is_finite(plane.row(j) + columns.begin, columns.count())) return false;
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
