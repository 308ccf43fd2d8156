// An independent oracle: the three systems of Turk's thesis and Gray-Scott, in double precision.
//
// Written from the C listings of appendix B (G. Turk, "Texturing Surfaces Using
// Reaction-Diffusion", 1992) and from J. E. Pearson, "Complex Patterns in a Simple System",
// Science 261, 1993. It shares nothing with the compiler: no header, no formula, no order of
// summation.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace cascade::oracle {

/// Rows × columns of cells. An axis of one cell has no neighbours along it.
struct Surface {
    std::size_t width = 1;
    std::size_t height = 1;
    bool periodic = true;  ///< If false, the value beyond a side is that of the cell at the side.

    std::size_t cells() const { return width * height; }
};

/// One number per cell, row by row.
using Values = std::vector<double>;

/// Chemicals, parameters, `speed` and `frozen` (not 0 where a cell is frozen) by their names.
using State = std::map<std::string, Values>;

/// Takes `steps` simultaneous Euler steps of appendix B.1: chemicals a b, parameters diff_a diff_b
/// beta ka.
void turing_spots(const Surface& surface, State& state, int steps);

/// Appendix B.2: chemicals a b, parameters p1 p2 p3 ai diff1 diff2 s.
void autocatalysis(const Surface& surface, State& state, int steps);

/// Appendix B.3: chemicals a b c d e, parameters p1 p2 p3 ai diff1 diff2.
void stripes(const Surface& surface, State& state, int steps);

/// Pearson's equations 2, with the time and length of the grid: chemicals u v, parameters feed kill
/// diff_u diff_v.
void gray_scott(const Surface& surface, State& state, int steps);

}  // namespace cascade::oracle
