// Cells like those of a surface, for benchmarks: the points of a jittered grid on a torus, linked
// by triangles, six neighbours each on average and four to eight each.
#pragma once

#include "core/links.h"
#include "core/vector3.h"

#include <cstddef>
#include <string>
#include <vector>

namespace cascade::bench {

struct LinkedCells {
    std::vector<Vector3d> positions;
    LinkList links;
};

/// side² cells in random order, as a model's own order may be.
LinkedCells cells_of_torus(std::size_t side);

/// The same cells as steps are fastest ("steps"), along a curve ("curve"), by levels ("levels") or
/// as they are ("own"), then grouped by their number of links in windows of that number of cells,
/// if it is not 0.
LinkedCells in_order(const LinkedCells& cells, const std::string& order, std::size_t window);

}  // namespace cascade::bench
