// Detects values that jump back and forth from step to step because steps are too long.
#pragma once

#include "core/plane.h"

#include <cstddef>
#include <span>
#include <vector>

namespace cascade {

/// Receives the state after each of a few steps and compares each change with the change before it.
/// A change counts if it is at least a tenth of the species' deviation and at least a thousandth of
/// its root mean square. Smaller changes are harmless or rounding errors.
class FlickerWatch {
public:
    /// `inside` marks the cells that count. If it is null, all cells count.
    explicit FlickerWatch(const Mask* inside = nullptr) : inside_(inside) {}

    /// Adds the state after one more step. The first call sets the state to compare with.
    void see(std::span<const Field> species);

    struct Finding {
        /// The fraction of cells that flicker: each change undid the previous change and was at
        /// most a twentieth smaller.
        double flickering = 0;
        /// The fraction of all changes, in all cells, that undid a part of the previous change. It
        /// is one half if changes have random signs, and higher if steps are so long that values do
        /// not settle into a regular oscillation.
        double undone = 0;
        double largest = 0;  ///< The largest change of a flickering cell in the last step.
    };
    Finding finding(std::size_t species) const;

private:
    struct Species {
        Field before_last, last;
        Mask steady;  ///< Is 1 where every change so far has undone the previous change.
        /// The number of cells, and of flickering cells, at the last comparison.
        double cells = 0, flickering = 0;
        /// The number of comparisons, and of changes undone in any of them.
        double comparisons = 0, undone = 0;
        double largest = 0;
    };
    void compare(Species& seen, const Field& now) const;

    const Mask* inside_;
    std::vector<Species> seen_;
};

}  // namespace cascade
