// The kernel of what cells sense of their surroundings, evaluated wherever rates are.
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

/// A value at the place nearest to a cell. Called by several threads at once.
using PlaceValue = std::function<double(const NearPlace& near)>;

/// Something that cells sense.
struct Sense {
    enum class Kind : std::uint8_t { off, normal_x, normal_y, normal_z, value };
    Kind kind = Kind::off;
    PlaceValue value = {};  ///< For `value`.
};

// On a surface; the arguments must outlive the values.
/// The size of the nearest triangle: the square root of its area.
PlaceValue feature_of(const SurfaceMesh& mesh);
/// Values at the points of the mesh, such as curvatures and attributes, linear between them.
PlaceValue of_points(const SurfaceMesh& mesh, std::vector<float> values);
/// Values in the cells of a model, smooth between them.
PlaceValue of_cells(const CellFilter& filter, std::vector<float> values);
/// On a plane: values in the cells of a grid over it, whose longest side has length 1; linear
/// between the centres of cells.
PlaceValue of_grid(const Field& values, Boundaries boundary);

/// The triangles nearest to the cells of a tissue, in the order of memory. Every evaluation of a
/// step begins from those of the last complete step, so that it depends on nothing but places.
struct NearTriangles {
    std::vector<std::uint32_t> before;  ///< At the last complete step: one for each cell.
    std::vector<std::uint32_t> now;     ///< Where the last evaluation found the cell.

    /// Begins at the triangles of a complete step.
    void begin(std::span<const std::uint32_t> triangles) {
        before.assign(triangles.begin(), triangles.end());
        now = before;
    }
};

/// Fields: the three components of place. Results: one for each sense. `triangles` must have an
/// entry for each cell whenever the kernel is run; the places after the last cell are as that. The
/// kernel keeps what the first `kept` cells sensed last, since several steps and rates ask for the
/// same places. Throws std::bad_alloc.
KernelPointer make_sense_kernel(std::shared_ptr<const Surroundings> surroundings,
                                std::vector<Sense> senses, std::shared_ptr<NearTriangles> triangles,
                                std::int64_t kept = 0);

}  // namespace cascade
