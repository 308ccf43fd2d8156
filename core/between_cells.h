// Values between the cells of a row: cubic curves that stay in range at sharp edges.
//
// Through each cell goes a cubic Hermite curve whose slope there is the mean of the differences to
// both neighbours (E. Catmull and R. Rom, 1974), but at most three times the smaller of them, so
// that the curve rises where values rise (F. Fritsch and R. Carlson, "Monotone Piecewise Cubic
// Interpolation", SIAM J. Numer. Anal. 17, 1980) and is even beside an even stretch. Around a
// smooth extremum that would leave a plateau. So the slope may be as large as the smallest of the
// three bends (second differences) in the cell and its neighbours if they have one sign; beside an
// edge they have not (P. Colella and M. Sekora, "A limiter for PPM that preserves accuracy at
// smooth extrema", J. Comput. Phys. 227, 2008). Of cells with two values no curve leaves their
// range. Elsewhere a crest between cells may be higher than both. That is right for what is looked
// at; where a run goes on, and a negative value may have no meaning, slopes are limited further.
// The functions are always inlined, so that compilers make vectors of loops that call them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace cascade {

/// The cells that a place between the third and the fourth of them depends on.
inline constexpr std::size_t cells_between = 6;

/// The slope in the middle one of five cells, per cell.
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

/// The value at `part`, 0 … 1, of the way from a cell to the next one, whose slopes are `first` and
/// `last`.
template <typename Number>
[[gnu::always_inline]] inline Number value_on_curve(Number from, Number to, Number first,
                                                    Number last, Number part) {
    const Number rise = to - from;
    return from +
           part * (first + part * (3 * rise - 2 * first - last + part * (first + last - 2 * rise)));
}

/// The value at `part`, 0 … 1, of the way from the third of six cells to the fourth. NaN if one of
/// the four in the middle is.
template <typename Number>
[[gnu::always_inline]] inline Number value_between(const std::array<Number, cells_between>& v,
                                                   Number part) {
    return value_on_curve(v[2], v[3], slope_in(v[0], v[1], v[2], v[3], v[4]),
                          slope_in(v[1], v[2], v[3], v[4], v[5]), part);
}

/// slope_in(), limited so that the curves on both sides stay in the range of the four cells around
/// them: a curve lies between its ends and the points a third of a cell from them along its slopes.
template <typename Number>
[[gnu::always_inline]] inline Number slope_in_range(Number a, Number b, Number c, Number d,
                                                    Number e) {
    const Number low = std::min(b, std::min(c, d)), high = std::max(b, std::max(c, d));
    const Number least = std::max(std::min(low, e) - c, c - std::max(high, a));
    const Number largest = std::min(std::max(high, e) - c, c - std::min(low, a));
    return std::clamp(slope_in(a, b, c, d, e), 3 * least, 3 * largest);
}

/// value_between() with a curve that stays in the range of the four cells in the middle. Values at
/// evenly spread places have the mean of the cells, as they have on any curve whose slopes on both
/// sides of each cell are the same.
template <typename Number>
[[gnu::always_inline]] inline Number value_in_range(const std::array<Number, cells_between>& v,
                                                    Number part) {
    const Number value = value_on_curve(v[2], v[3], slope_in_range(v[0], v[1], v[2], v[3], v[4]),
                                        slope_in_range(v[1], v[2], v[3], v[4], v[5]), part);
    // Rounding may leave the range.
    return std::clamp(value, std::min(std::min(v[1], v[2]), std::min(v[3], v[4])),
                      std::max(std::max(v[1], v[2]), std::max(v[3], v[4])));
}

}  // namespace cascade
