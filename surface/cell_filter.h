// Smooth interpolation of cell values on a surface.
//
// G. Turk, "Texturing Surfaces Using Reaction-Diffusion" (thesis, 1992), section 5.4.1: the value
// at a position is the average of the values of the cells around it with the weights
//
//     w(d / s) = 2 (d / s)³ − 3 (d / s)² + 1    for d < s, and 0 beyond.
//
// Turk measures d in space and uses s = 2 r, where r = 2 √(area / cells) is the repulsion radius.
// Here d is measured along the surface if this is longer than the distance in space, so that the
// two sides of a leaf do not mix. s = r, so the average includes about twelve cells.
#pragma once

#include "core/parallel.h"
#include "surface/cell_images.h"
#include "surface/voronoi_cells.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// The weight of a cell at a position.
struct CellShare {
    std::uint32_t cell = 0;
    float weight = 0;
};

/// A cell's weight and the weight's gradient in the plane of the triangle. The gradient is a change
/// per radius of the filter.
struct SlopedShare {
    std::uint32_t cell = 0;
    float weight = 0;
    Vector3 slope;
};

/// Interpolates cell values. Thread-safe. Stores no reference to the cells or the mesh.
class CellFilter {
public:
    /// For each cell, finds the triangles that are nearer than the radius. There must be at least
    /// one cell. The result is the same with any number of threads. Throws std::bad_alloc.
    CellFilter(const SurfaceMesh& mesh, const SurfaceCells& cells, Team& team);

    /// The cells near a position, in ascending order, with weights ≥ 0 that sum to 1. If no cell is
    /// within the radius, gives only the cell that is nearest along the surface or, if the
    /// position's component has no cells, nearest in space. Replaces `out`.
    void shares(const SurfacePlace& place, std::vector<CellShare>& out) const;

    /// The cells and weights of shares(), with the gradients of the weights, which sum to 0. On
    /// curved surfaces, the error of gradients is a few hundredths.
    void sloped_shares(const SurfacePlace& place, std::vector<SlopedShare>& out) const;

    /// The radius s. Cells farther away have no weight.
    double radius() const { return radius_; }

private:
    /// A triangle laid flat, with its longest edge along the x axis from the origin. The unit of
    /// length is the filter's radius. The triangle is covered by boxes of side 1.
    struct Patch {
        Vector3 origin;
        Vector3 x_axis, y_axis;  ///< Unit vectors in space.
        /// Coordinates of the second and third corner.
        float second_x = 0, third_x = 0, third_y = 0;
        std::uint32_t first_corner = 0;  ///< The corner at the origin.
        std::uint32_t columns = 1, rows = 1;
        std::uint32_t otherwise = 0;  ///< The cell to use if no cell is near.
        std::uint32_t first_box = 0;
    };
    /// The position of a cell unfolded into a triangle's plane, as seen from some of the triangle's
    /// edges.
    struct Sighting {
        std::uint32_t cell = 0;
        std::uint32_t edges = 0;  ///< One bit per edge.
        float x = 0, y = 0;
    };
    /// A cell within the radius.
    struct Near {
        std::uint32_t cell = 0;
        float square = 0;    ///< The squared distance.
        float x = 0, y = 0;  ///< The vector from the cell to the position.
    };
    struct FlatPoint {
        float x = 0, y = 0;
        /// The weights of the edges, with sum 1. On an edge, that edge has weight 1.
        std::array<float, 3> edges{};
    };
    /// The sightings of one image.
    struct Sightings {
        std::array<Sighting, 3> all;
        std::size_t count = 0;
    };

    static FlatPoint flat_point(const Patch& patch, const SurfacePlace& place);
    static std::uint32_t box_of(const Patch& patch, FlatPoint place);
    std::span<const Sighting> sightings_of(std::uint32_t first_box, std::uint32_t boxes) const;
    template <typename Visit>
    void visit_near(const Patch& patch, FlatPoint place, const Visit& visit) const;
    std::uint32_t nearest_cell(const Patch& patch, FlatPoint place) const;
    void lay_out(const SurfaceMesh& mesh, const SurfaceCells& cells,
                 std::span<const FlatTriangle> frames);
    void fill_boxes(const SurfaceMesh& mesh, const SurfaceCells& cells,
                    std::span<const FlatTriangle> frames, Team& team);
    static Sightings sightings_in(const CellImage& image, std::uint32_t cell);
    template <typename Visit>
    void visit_boxes(const CellImage& image, const Visit& visit) const;
    void find_substitutes(const SurfaceMesh& mesh, const SurfaceCells& cells);

    double radius_ = 0;
    /// The cells' positions in space, relative to the first cell.
    std::vector<Vector3> positions_;
    std::vector<Patch> patches_;  ///< One per triangle.
    /// The sightings of box b end before sightings_[box_ends_[b]].
    std::vector<std::size_t> box_ends_;
    std::vector<Sighting> sightings_;  ///< Sorted by box, then by cell.
};

}  // namespace cascade
