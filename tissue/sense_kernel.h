// The kernel of senses. At each evaluation of the rates, it computes the values that cells sense in
// their surroundings.
#pragma once

#include "core/plane.h"
#include "ir/backend.h"
#include "surface/cell_filter.h"
#include "tissue/surroundings.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace cascade {

/// A value at the position nearest to a cell. Called by several threads at once.
using PlaceValue = std::function<double(const NearPlace& near)>;

/// A value that cells sense.
struct Sense {
    enum class Kind : std::uint8_t { off, normal_x, normal_y, normal_z, value };
    Kind kind = Kind::off;
    PlaceValue value = {};  ///< Used for senses of the kind `value`.
};

// The next three functions are for surfaces. The mesh or filter given to each of them must outlive
// its result.
/// A PlaceValue that gives the size of the nearest triangle: the square root of its area.
PlaceValue feature_of(const SurfaceMesh& mesh);
/// A PlaceValue that interpolates linearly between values given at the points of the mesh, such as
/// curvatures and attributes.
PlaceValue of_points(const SurfaceMesh& mesh, std::vector<float> values);
/// A PlaceValue that interpolates smoothly between values given in the cells of a model.
PlaceValue of_cells(const CellFilter& filter, std::vector<float> values);
/// A PlaceValue for planes that interpolates linearly between the centres of the cells of a grid.
/// The grid covers a plane whose longest side has length 1.
PlaceValue of_grid(const Field& values, Boundaries boundary);

/// The triangles nearest to the cells of a tissue, in the order of memory. Every search within a
/// step begins at the triangles of the last complete step, so that results depend only on
/// positions.
struct NearTriangles {
    /// The nearest triangles at the last complete step, by cell.
    std::vector<std::uint32_t> before;
    std::vector<std::uint32_t> now;  ///< The nearest triangles at the last evaluation, by cell.

    /// Begins a step. Its searches begin at `triangles`, which were nearest at the last complete
    /// step.
    void begin(std::span<const std::uint32_t> triangles) {
        before.assign(triangles.begin(), triangles.end());
        now = before;
    }
};

/// Makes a kernel whose fields are the three components of the position, and which has one result
/// for each sense. `triangles` must have an entry for each cell whenever the kernel runs. Fields
/// have further elements after the last cell, which repeat its position. The kernel caches the last
/// results of the first `kept` cells, because rates are often evaluated several times at the same
/// positions. Throws std::bad_alloc.
KernelPointer make_sense_kernel(std::shared_ptr<const Surroundings> surroundings,
                                std::vector<Sense> senses, std::shared_ptr<NearTriangles> triangles,
                                std::int64_t kept = 0);

}  // namespace cascade
