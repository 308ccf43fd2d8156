// Compares the paths of steps of two lengths from one state. If they differ, steps are too long.
#pragma once

#include "core/plane.h"

#include <cstddef>
#include <span>
#include <vector>

namespace cascade {

/// The path of a few steps from a state, and its length.
class StepPath {
public:
    /// `inside` says which cells count; nullptr: all.
    explicit StepPath(const Mask* inside = nullptr) : inside_(inside) {}

    /// Adds the state after one more step. The first call sets the start of the path.
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

    /// One path is longer than twice the other, or their ends are farther apart than half of the
    /// longer path, and that path is at least a hundredth of the values. Steps that are short
    /// enough are far from this limit: even an advected edge of one cell has a path at most √3
    /// times as long as with steps three times as long.
    bool is_apart = false;
};
PathDifference difference(const StepPath& coarse, const StepPath& fine, std::size_t species,
                          const Mask* inside);

}  // namespace cascade
