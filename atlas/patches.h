// Divides a surface where it bends.
#pragma once

#include "atlas/chart.h"

#include <array>
#include <atomic>

namespace cascade {

/// Divides a surface of area 1 into connected patches. In each patch few triangles are rotated by
/// more than 50° from the patch's mean normal. Returns the patch of each triangle, 0 … patches − 1.
/// Patches grow from seeds: a triangle belongs to the seed from which the path is cheapest, where a
/// path costs its length plus its bends. Then each seed moves to the middle of its patch, and
/// patches grow again. A patch that bends too much gets a second seed. P. Sander et al.,
/// "Multi-Chart Geometry Images", Symposium on Geometry Processing 2003, section 3. The result is
/// the same in every run. It is meaningless if `cancel` became true.
std::vector<std::uint32_t> bend_patches(const SurfaceMesh& mesh, const std::atomic<bool>& cancel);

/// Divides the triangles of a chart, at least two, into two connected parts. The parts grow from
/// two triangles that are far apart. `numbers` must be unchanged since chart_of() set it for this
/// chart.
std::array<std::vector<std::uint32_t>, 2> halves(const SurfaceMesh& mesh, const Seams& seams,
                                                 const Chart& chart,
                                                 std::span<const std::uint32_t> numbers);

}  // namespace cascade
