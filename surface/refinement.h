// Refines a mesh by cutting long edges, for quantities computed at its points.
#pragma once

#include "mesh/flat.h"

#include <atomic>
#include <cstdint>
#include <vector>

namespace cascade {

/// The same surface with more triangles. Halves the longest edge again and again, each time
/// together with the triangles on both sides, until no edge is longer than `longest_edge` or
/// `most_cuts` cuts were made (M.-C. Rivara, "Algorithms for refining triangular grids suitable for
/// adaptive and multigrid techniques", 1984, explains why triangles stay well shaped). The points
/// of the mesh keep their indices. Texture coordinates and attributes are left out.
class Refinement {
public:
    Refinement(const SurfaceMesh& mesh, double longest_edge, std::size_t most_cuts,
               const std::atomic<bool>& cancel);

    const SurfaceMesh& mesh() const { return mesh_; }
    /// Converts a position on the original mesh to this mesh.
    SurfacePlace refined(SurfacePlace place) const;

private:
    static constexpr std::uint32_t none = 0xffffffff;

    /// Records that a triangle was cut from the middle of its edge `edge` to the opposite corner.
    /// The part with the edge's first half has the triangle's index, and `second` is the index of
    /// the other part.
    struct Cut {
        std::uint32_t edge = 0;
        std::uint32_t second = 0;
        std::uint32_t next = none;  ///< The next cut of the part that has the triangle's index.
    };
    struct Cuts {
        std::uint32_t first = none, last = none;
    };

    void cut(TriangleEdge edge);
    std::uint32_t cut_triangle(TriangleEdge edge, std::uint32_t middle);
    void link(TriangleEdge a, TriangleEdge b);

    SurfaceMesh mesh_;
    std::vector<Cut> cuts_;
    std::vector<Cuts> cuts_of_;  ///< The cuts of each triangle since it was created.
};

}  // namespace cascade
