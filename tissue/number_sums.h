// Sums over the cells of a tissue in the order of their numbers, so that they do not depend on
// memory.
#pragma once

#include "core/parallel.h"
#include "tissue/tissue.h"
#include "tissue/tissue_rules.h"

#include <cstddef>
#include <vector>

namespace cascade {

/// The root mean square over the cells of each of these planes, or of their differences to
/// `others`; NaN if one is NaN. Threads share the planes.
std::vector<double> root_mean_squares(const std::vector<Field>& fields, const Tissue& tissue,
                                      Team& team, const std::vector<Field>* others = nullptr);

/// The size of each species, which errors and speeds are compared with: the mean radius for places,
/// for others their root mean square, and at least 1e-30.
std::vector<double> sizes_of(const std::vector<Field>& species, const Tissue& tissue,
                             const TissueSpecies& roles, double mean_radius, Team& team);

}  // namespace cascade
