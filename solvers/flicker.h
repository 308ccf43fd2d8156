// Do values jump back and forth from step to step, as they do when steps are too long for them?
#pragma once

#include "core/plane.h"

#include <cstddef>
#include <span>
#include <vector>

namespace cascade {

/// Is shown the state after each of a few steps, and compares each change with the one before.
/// Changes count from a tenth of the species' deviation on, but at least a thousandth of its root
/// mean square: less is no matter, or rounding.
class FlickerWatch {
public:
    /// `inside` says which cells count; nullptr: all.
    explicit FlickerWatch(const Mask* inside = nullptr) : inside_(inside) {}

    /// The state after one more step. The first one is that before.
    void see(std::span<const Field> species);

    struct Finding {
        /// The part of the cells in which each change undid the one before, and was no smaller by
        /// more than a twentieth.
        double flickering = 0;
        /// The part of all changes of all cells that undid the one before, by whatever part: much
        /// of those in steps that are too long to settle even into a to and fro, half of those of
        /// random numbers.
        double undone = 0;
        double largest = 0;  ///< The largest last change of a cell that flickers.
    };
    Finding finding(std::size_t species) const;

private:
    struct Species {
        Field before_last, last;
        Mask steady;                         ///< 1 where all changes so far undid each other.
        double cells = 0, flickering = 0;    ///< At the last comparison.
        double comparisons = 0, undone = 0;  ///< So far.
        double largest = 0;
    };
    void compare(Species& seen, const Field& now) const;

    const Mask* inside_;
    std::vector<Species> seen_;
};

}  // namespace cascade
