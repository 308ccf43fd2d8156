// Compares two paths from one state, with long and with short steps. If the paths differ, steps are
// too long.
#pragma once

#include "core/plane.h"

#include <cstddef>
#include <span>
#include <vector>

namespace cascade {

/// The path of a few steps from a state, and its length.
class StepPath {
public:
    /// `inside` marks the cells that count. If it is null, all cells count.
    explicit StepPath(const Mask* inside = nullptr) : inside_(inside) {}

    /// Adds the state after one more step. The first call sets the start of the path.
    void see(std::span<const Field> species);

    std::size_t species_count() const { return last_.size(); }
    /// The length of the path: the sum of the changes of all steps, where a change is a root mean
    /// square over the cells.
    double length(std::size_t species) const { return lengths_[species]; }
    const Field& end(std::size_t species) const { return last_[species]; }

private:
    const Mask* inside_;
    std::vector<Field> last_;
    std::vector<double> lengths_;
};

/// The difference between two paths from one state.
struct PathDifference {
    double coarse = 0, fine = 0;  ///< Lengths of the paths of long and of short steps.
    /// The distance between the ends of the two paths, as a root mean square over the cells.
    double apart = 0;

    /// Whether the paths differ, that is: one path is more than twice as long as the other, or
    /// their ends are farther apart than half of the longer path. In addition, the longer path must
    /// be at least a hundredth of the root mean square of the values. Steps that are short enough
    /// are far from this limit: with steps three times as long, the path of an advected edge one
    /// cell wide is at most √3 times as long.
    bool is_apart = false;
};
PathDifference difference(const StepPath& coarse, const StepPath& fine, std::size_t species,
                          const Mask* inside);

}  // namespace cascade
