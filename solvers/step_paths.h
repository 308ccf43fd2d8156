// Do steps of two lengths lead the same way from one state? Where they do not, steps are too long.
#pragma once

#include "core/plane.h"

#include <cstddef>
#include <span>
#include <vector>

namespace cascade {

/// Where a few steps lead from a state, and how long the way is.
class StepPath {
public:
    /// `inside` says which cells count; nullptr: all.
    explicit StepPath(const Mask* inside = nullptr) : inside_(inside) {}

    /// The state after one more step. The first one is that before.
    void see(std::span<const Field> species);

    std::size_t species_count() const { return last_.size(); }
    /// The sum of the changes of all steps, each a root mean square over the cells.
    double length(std::size_t species) const { return lengths_[species]; }
    const Field& end(std::size_t species) const { return last_[species]; }

private:
    const Mask* inside_;
    std::vector<Field> last_;
    std::vector<double> lengths_;
};

/// How two paths from one state differ.
struct PathDifference {
    double coarse = 0, fine = 0;  ///< Lengths of the paths of long and of short steps.
    double apart = 0;             ///< Distance of their ends, root mean square over the cells.

    /// One way is longer than twice the other, or the ends lie farther apart than half of the
    /// longer way; and that way is a hundredth of the values or more. Steps that are short enough
    /// are far from it: even an edge of one cell that is carried along has a way no longer than √3
    /// times that of steps of three times the length.
    bool is_apart = false;
};
PathDifference difference(const StepPath& coarse, const StepPath& fine, std::size_t species,
                          const Mask* inside);

}  // namespace cascade
