// Division of a surface where it bends.
#pragma once

#include "atlas/chart.h"

#include <array>
#include <atomic>

namespace cascade {

/// Divides a surface of area 1 into connected patches, few of whose triangles are rotated by more
/// than 50° from the patch's mean normal. Returns the patch of each triangle, 0 … patches − 1.
/// Patches grow from seeds by least cost, the distance plus a cost of bends, and the seeds move to
/// the middles of their patches. A patch that bends too much gets a second seed. P. Sander et al.,
/// "Multi-Chart Geometry Images", Symposium on Geometry Processing 2003, section 3. Meaningless if
/// `cancel` became true. Deterministic.
std::vector<std::uint32_t> bend_patches(const SurfaceMesh& mesh, const std::atomic<bool>& cancel);

/// Divides the triangles of a chart, at least two, into two connected parts that grow from its far
/// ends. `numbers` is as chart_of() left it.
std::array<std::vector<std::uint32_t>, 2> halves(const SurfaceMesh& mesh, const Seams& seams,
                                                 const Chart& chart,
                                                 std::span<const std::uint32_t> numbers);

}  // namespace cascade
