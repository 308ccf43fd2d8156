// The positions of cells in the planes of triangles into which the surface is unfolded.
#pragma once

#include "mesh/flat.h"

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// Each triangle laid flat with its longest edge along the x axis, from the origin.
std::vector<FlatTriangle> longest_edge_frames(const SurfaceMesh& mesh);

/// The corner of a triangle that is at the origin of its frame.
std::uint32_t longest_edge(const SurfaceMesh& mesh, std::uint32_t triangle);

/// The position of a cell in the plane of a triangle (longest_edge_frames), in units of the radius,
/// with the surface between cell and triangle unfolded. Around a corner of a curved surface,
/// several ways of unfolding lead to the same triangle. So a position is stored for each edge of
/// the triangle. The two triangles at an edge share this position.
struct CellImage {
    struct Point {
        float x = 0, y = 0;
    };
    std::uint32_t triangle = 0;
    std::array<Point, 3> from_edges;
};

/// Finds the images of positions. Refers to its arguments, which must outlive it. Not thread-safe.
class ImageFinder {
public:
    ImageFinder(const SurfaceMesh& mesh, std::span<const FlatTriangle> frames, double radius);

    /// The images of a cell at this position in all triangles reached within the radius, along the
    /// surface and in space. An edge that is not reached gets the image of another edge. This does
    /// no harm, because positions at such an edge are farther from either image than the radius.
    /// Valid until the next call.
    std::span<const CellImage> find(const SurfacePlace& place);

private:
    static constexpr std::uint32_t none = 3;

    /// A visited triangle.
    struct Seen {
        std::uint32_t triangle = 0;
        std::array<bool, 3> is_reached{};  ///< Whether the image has crossed each edge.
        std::array<Vector2d, 3> from_edges;
    };
    /// An edge of a visited triangle, as one number that sorts the nearest first: the bits of the
    /// squared distance (which sort like the number if it is ≥ 0), then 4 times the index in seen_,
    /// plus the edge's index. Moving one word is faster than moving a structure of two words.
    __extension__ using Front = unsigned __int128;
    static Front front_at(double square_distance, std::uint32_t seen, std::uint32_t edge) {
        return Front{std::bit_cast<std::uint64_t>(square_distance)} << 64 |
               (std::uint64_t{seen} * 4 + edge);
    }
    /// The last call that visited a triangle, and the index of that visit in seen_.
    struct LastSeen {
        std::uint32_t call = 0;
        std::uint32_t number = 0;
    };

    void enter(TriangleEdge edge, Vector2d source);
    void hand_on(std::uint32_t seen, std::uint32_t edge);
    Vector2d carried(TriangleEdge edge, TriangleEdge other, Vector2d point) const;

    const SurfaceMesh& mesh_;
    std::span<const FlatTriangle> frames_;
    double radius_;
    std::uint32_t call_ = 0;
    Vector3d position_;
    std::vector<LastSeen> last_seen_;  ///< One per triangle.
    std::vector<Seen> seen_;
    std::vector<Front> fronts_;  ///< A heap of edges, the nearest on top.
    std::vector<CellImage> images_;
};

}  // namespace cascade
