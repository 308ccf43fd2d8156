// A mesh with its long edges cut, for what is computed at points and has to be known between them.
#pragma once

#include "mesh/flat.h"

#include <atomic>
#include <cstdint>
#include <vector>

namespace cascade {

/// The same surface of more triangles. The longest edge is halved, and with it the triangles on
/// both sides, until no edge is longer than `longest_edge` or `most_cuts` were made (M.-C. Rivara,
/// "Algorithms for refining triangular grids suitable for adaptive and multigrid techniques", 1984,
/// on why halving longest edges keeps triangles well shaped). The points of the mesh keep their
/// numbers. Texture places and attributes are left out.
class Refinement {
public:
    Refinement(const SurfaceMesh& mesh, double longest_edge, std::size_t most_cuts,
               const std::atomic<bool>& cancel);

    const SurfaceMesh& mesh() const { return mesh_; }
    /// Where a place of the first mesh lies in this one.
    SurfacePlace refined(SurfacePlace place) const;

private:
    static constexpr std::uint32_t none = 0xffffffff;

    /// A triangle was cut from the middle of its edge `edge` to the corner opposite. It kept its
    /// number and the edge's first half; `second` got the other half.
    struct Cut {
        std::uint32_t edge = 0;
        std::uint32_t second = 0;
        std::uint32_t next = none;  ///< The next one of what kept the number.
    };
    struct Cuts {
        std::uint32_t first = none, last = none;
    };

    void cut(TriangleEdge edge);
    std::uint32_t cut_triangle(TriangleEdge edge, std::uint32_t middle);
    void link(TriangleEdge a, TriangleEdge b);

    SurfaceMesh mesh_;
    std::vector<Cut> cuts_;
    std::vector<Cuts> cuts_of_;  ///< Of each triangle, those of before it was there left out.
};

}  // namespace cascade
