// A surface mesh while points are put into it and taken away. Its topology never changes.
#pragma once

#include "mesh/surface_mesh.h"

#include <span>
#include <utility>

namespace cascade {

/// The triangles around a point, counterclockwise. Triangle k lies between rim[k] and rim[k + 1],
/// where the rim of a closed fan begins anew after its end; an open one, of a point at a boundary,
/// has one point more than triangles.
struct Fan {
    bool is_closed = false;
    std::vector<std::uint32_t> triangles;
    std::vector<std::uint32_t> rim;
    std::vector<TriangleEdge> beyond;  ///< What lies across the edge from rim[k] to rim[k + 1].
};

class EditedMesh {
public:
    /// `mesh` without its texture and attributes. Every triangle must have three different corners.
    explicit EditedMesh(const SurfaceMesh& mesh);

    const SurfaceMesh& mesh() const { return mesh_; }
    bool has_triangle(std::uint32_t t) const { return mesh_.triangles[t][0] != TriangleEdge::none; }

    /// Adds a point that no triangle uses yet.
    std::uint32_t add_point(Vector3d position);

    /// Puts a point into the middle of a triangle, which keeps its first two corners; two triangles
    /// are added.
    void split_triangle(std::uint32_t triangle, std::uint32_t point);

    /// Puts a point into the middle of an edge. The triangle keeps the edge's start, that across it
    /// its end. Adds a triangle on the edge's side and then, if there is one, on the other side.
    void split_edge(TriangleEdge edge, std::uint32_t point);

    /// Exchanges the edge between two triangles for the line between the corners that face it
    /// (surface/exchange_edges.h).
    void exchange(TriangleEdge edge);

    void fan_around(std::uint32_t point, Fan& fan) const;

    /// Whether an edge goes from one point to the other. Looks at both in turn, so that it takes no
    /// longer than the smaller fan does.
    bool are_neighbours(std::uint32_t a, std::uint32_t b) const;

    /// Takes a point away with its fan and puts triangles of rim numbers in its place. Each must
    /// cut off the middle one of its corners from the rim that is left; the last is all that is
    /// left.
    void replace_fan(std::uint32_t point, const Fan& fan,
                     std::span<const std::array<std::uint32_t, 3>> ears);

    /// Triangles that were made or changed since this was asked last, some several times or gone
    /// since.
    std::vector<std::uint32_t> take_changed() { return std::exchange(changed_, {}); }

    /// The mesh of the points in `kept`, in this order; they must be all that are used.
    SurfaceMesh without_gaps(std::span<const std::uint32_t> kept) const;

private:
    void set_triangle(std::uint32_t t, std::array<std::uint32_t, 3> corners);
    void link(TriangleEdge here, TriangleEdge other);
    TriangleEdge next_around(TriangleEdge corner) const;
    TriangleEdge previous_around(TriangleEdge corner) const;

    SurfaceMesh mesh_;
    std::vector<TriangleEdge> corner_of_;  ///< A triangle at each point and the corner that it is.
    std::vector<std::uint32_t> changed_;
};

}  // namespace cascade
