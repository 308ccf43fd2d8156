// A path's length is the sum of the root mean squares of its changes from state to state.
#include "solvers/step_paths.h"

#include "solvers/field_norms.h"

#include <algorithm>

namespace cascade {

namespace {

/// Two paths differ if their ends are farther apart than this fraction of the longer path, or if
/// the shorter path is less than this fraction of the longer.
constexpr double half_the_way = 0.5;
/// If the longer path is a smaller fraction of the values than this, the state is at rest and both
/// paths are rounding errors.
constexpr double least_part_of_values = 0.01;

}  // namespace

void StepPath::see(std::span<const Field> species) {
    const bool is_first = last_.empty();
    lengths_.resize(species.size());
    for (std::size_t k = 0; k < species.size(); ++k) {
        if (is_first) {
            last_.push_back(species[k].clone());
            continue;
        }
        lengths_[k] += root_mean_square_of_difference(species[k], last_[k], inside_);
        last_[k] = species[k].clone();
    }
}

PathDifference difference(const StepPath& coarse, const StepPath& fine, std::size_t species,
                          const Mask* inside) {
    PathDifference found;
    found.coarse = coarse.length(species);
    found.fine = fine.length(species);
    found.apart = root_mean_square_of_difference(coarse.end(species), fine.end(species), inside);
    const double longer = std::max(found.coarse, found.fine);
    const double shorter = std::min(found.coarse, found.fine);
    const double values = std::max(root_mean_square(coarse.end(species), inside),
                                   root_mean_square(fine.end(species), inside));
    const bool is_else = found.apart > half_the_way * longer || shorter < half_the_way * longer;
    found.is_apart = is_else && longer > least_part_of_values * values;
    return found;
}

}  // namespace cascade
