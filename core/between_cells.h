// Values between the cells of a row: cubic curves that stay in range at sharp edges.
//
// Each pair of cells is joined by a cubic Hermite curve. The slope at a cell is the mean of the
// differences to both neighbours (E. Catmull and R. Rom, 1974), but at most three times the smaller
// difference, so that the curve is monotone wherever the values are monotone (F. Fritsch and R.
// Carlson, "Monotone Piecewise Cubic Interpolation", SIAM J. Numer. Anal. 17, 1980). This limit
// alone would flatten smooth extrema. So if the three bends (second differences) in the cell and
// its two neighbours have one sign, the slope may be as large as the smallest bend. Beside an edge,
// the bends differ in sign (P. Colella and M. Sekora, "A limiter for PPM that preserves accuracy at
// smooth extrema", J. Comput. Phys. 227, 2008). If the cells have only two different values, no
// curve leaves their range. Otherwise a crest between two cells may be higher than both values.
// Pictures may have such crests. In a run that continues from the interpolated values, a value out
// of range, such as a negative concentration, may be meaningless, so slope_in_range() limits slopes
// further. The functions are always inlined, so that compilers vectorise loops that call them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace cascade {

/// The number of cells that determine a value between two cells of a row: these two cells and two
/// more on either side.
inline constexpr std::size_t cells_between = 6;

/// The slope of the curve, per cell, at the third of five cells in a row.
template <typename Number>
[[gnu::always_inline]] inline Number slope_in(Number a, Number b, Number c, Number d, Number e) {
    const Number before = c - b, after = d - c;
    const Number bend = after - before, left = before - (b - a), right = e - d - after;
    const Number least = std::min(bend, std::min(left, right));
    const Number largest = std::max(bend, std::max(left, right));
    const Number smooth = std::max(Number(0), std::max(least, -largest));
    const Number most = std::max(3 * std::min(std::abs(before), std::abs(after)), smooth);
    return std::clamp((before + after) / 2, -most, most);
}

/// The value at the fraction `part`, 0 … 1, of the way from a cell to the next one. `first` and
/// `last` are the slopes at these cells.
template <typename Number>
[[gnu::always_inline]] inline Number value_on_curve(Number from, Number to, Number first,
                                                    Number last, Number part) {
    const Number rise = to - from;
    return from +
           part * (first + part * (3 * rise - 2 * first - last + part * (first + last - 2 * rise)));
}

/// The value at the fraction `part`, 0 … 1, of the way from the third of six cells to the fourth.
/// NaN if one of the middle four cells is NaN.
template <typename Number>
[[gnu::always_inline]] inline Number value_between(const std::array<Number, cells_between>& v,
                                                   Number part) {
    return value_on_curve(v[2], v[3], slope_in(v[0], v[1], v[2], v[3], v[4]),
                          slope_in(v[1], v[2], v[3], v[4], v[5]), part);
}

/// slope_in(), limited so that the curve on either side stays in the range of the four cells around
/// it. A curve stays in the range of its Bézier points: its two ends, and the points on the
/// tangents at its ends a third of a cell away.
template <typename Number>
[[gnu::always_inline]] inline Number slope_in_range(Number a, Number b, Number c, Number d,
                                                    Number e) {
    const Number low = std::min(b, std::min(c, d)), high = std::max(b, std::max(c, d));
    const Number least = std::max(std::min(low, e) - c, c - std::max(high, a));
    const Number largest = std::min(std::max(high, e) - c, c - std::min(low, a));
    return std::clamp(slope_in(a, b, c, d, e), 3 * least, 3 * largest);
}

/// value_between() with a curve that stays in the range of the middle four cells. The mean of
/// interpolated values at evenly spaced points equals the mean of the cells, because the curves on
/// both sides of a cell have the same slope there.
template <typename Number>
[[gnu::always_inline]] inline Number value_in_range(const std::array<Number, cells_between>& v,
                                                    Number part) {
    const Number value = value_on_curve(v[2], v[3], slope_in_range(v[0], v[1], v[2], v[3], v[4]),
                                        slope_in_range(v[1], v[2], v[3], v[4], v[5]), part);
    // Rounding may put `value` outside the range.
    return std::clamp(value, std::min(std::min(v[1], v[2]), std::min(v[3], v[4])),
                      std::max(std::max(v[1], v[2]), std::max(v[3], v[4])));
}

}  // namespace cascade
