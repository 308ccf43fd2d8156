// From a surface to charts that lie flat.
#pragma once

#include "atlas/chart.h"
#include "core/parallel.h"

#include <atomic>

namespace cascade {

/// Divides a surface of area 1 into flat charts without overlaps (is_injective). In a chart of more
/// than 1/512 of the area the mean distortion is at most 1.1, and above 1.5 in at most 1 % of its
/// area. Patches that bend little (bend_patches) are halved until they are so, and then joined
/// again along common edges, the longest ones first, as long as they stay so. Incomplete if
/// `cancel` became true. The same on any number of threads.
std::vector<Chart> make_charts(const SurfaceMesh& mesh, Team& team,
                               const std::atomic<bool>& cancel);

}  // namespace cascade
