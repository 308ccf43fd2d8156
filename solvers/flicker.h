// Detects values that jump back and forth from step to step because steps are too long.
#pragma once

#include "core/plane.h"

#include <cstddef>
#include <span>
#include <vector>

namespace cascade {

/// Receives the state after each of a few steps and compares each change with the previous one. A
/// change counts if it is at least a tenth of the species' deviation and a thousandth of its root
/// mean square. Smaller ones are harmless, or rounding.
class FlickerWatch {
public:
    /// `inside` says which cells count; nullptr: all.
    explicit FlickerWatch(const Mask* inside = nullptr) : inside_(inside) {}

    /// Adds the state after one more step. The first call sets the state to compare with.
    void see(std::span<const Field> species);

    struct Finding {
        /// The fraction of cells in which each change undid the previous one and was at most a
        /// twentieth smaller.
        double flickering = 0;
        /// The fraction of all changes of all cells that undid the previous one, to any degree:
        /// high if steps are too long even to settle into a regular oscillation, one half for
        /// random numbers.
        double undone = 0;
        double largest = 0;  ///< The largest last change of a flickering cell.
    };
    Finding finding(std::size_t species) const;

private:
    struct Species {
        Field before_last, last;
        Mask steady;                         ///< 1 where all changes so far undid each other.
        double cells = 0, flickering = 0;    ///< At the last comparison.
        double comparisons = 0, undone = 0;  ///< Over all comparisons.
        double largest = 0;
    };
    void compare(Species& seen, const Field& now) const;

    const Mask* inside_;
    std::vector<Species> seen_;
};

}  // namespace cascade
