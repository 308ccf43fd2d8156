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
    /// If false, the value beyond a side equals the value of the cell at the side.
    bool periodic = true;

    std::size_t cells() const { return width * height; }
};

/// One number per cell, row by row.
using Values = std::vector<double>;

/// Chemicals, parameters, `speed` and `frozen` (not 0 where a cell is frozen) by their names.
using State = std::map<std::string, Values>;

/// Takes `steps` Euler steps of appendix B.1, in which all cells change at the same time.
/// Chemicals: a b. Parameters: diff_a diff_b beta ka.
void turing_spots(const Surface& surface, State& state, int steps);

/// Takes steps of appendix B.2. Chemicals: a b. Parameters: p1 p2 p3 ai diff1 diff2 s.
void autocatalysis(const Surface& surface, State& state, int steps);

/// Takes steps of appendix B.3. Chemicals: a b c d e. Parameters: p1 p2 p3 ai diff1 diff2.
void stripes(const Surface& surface, State& state, int steps);

/// Takes steps of Pearson's equations (2), with the cell and the step as units of length and time.
/// Chemicals: u v. Parameters: feed kill diff_u diff_v.
void gray_scott(const Surface& surface, State& state, int steps);

}  // namespace cascade::oracle
