// Cells like cells of a surface, for benchmarks: the points of a jittered grid on a torus, linked
// by triangles. Each has four to eight neighbours, six on average.
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

/// side² cells in random order, because a model may have any order.
LinkedCells cells_of_torus(std::size_t side);

/// The cells in another order: the fastest for steps ("steps"), along a curve ("curve"), by levels
/// ("levels") or unchanged ("own"). If `window` is not 0, they are then grouped by their number of
/// links in windows of that number of cells.
LinkedCells in_order(const LinkedCells& cells, const std::string& order, std::size_t window);

}  // namespace cascade::bench
