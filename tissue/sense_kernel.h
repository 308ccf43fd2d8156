// The kernel of senses: what cells read from their surroundings, wherever rates are evaluated.
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
    PlaceValue value = {};  ///< Used by kind `value`.
};

// On a surface. The arguments must outlive the values.
/// The size of the nearest triangle: the square root of its area.
PlaceValue feature_of(const SurfaceMesh& mesh);
/// Values at the points of the mesh, such as curvatures and attributes, linear between them.
PlaceValue of_points(const SurfaceMesh& mesh, std::vector<float> values);
/// Values in the cells of a model, smooth between them.
PlaceValue of_cells(const CellFilter& filter, std::vector<float> values);
/// On a plane: values in the cells of a grid over it, whose longest side has length 1, linear
/// between the centres of cells.
PlaceValue of_grid(const Field& values, Boundaries boundary);

/// The triangles nearest to the cells of a tissue, in the order of memory. Every evaluation in a
/// step begins from the triangles of the last complete step, so that it depends only on positions.
struct NearTriangles {
    std::vector<std::uint32_t> before;  ///< At the last complete step, by cell.
    std::vector<std::uint32_t> now;     ///< By cell, at the last evaluation.

    /// Begins at the triangles of a complete step.
    void begin(std::span<const std::uint32_t> triangles) {
        before.assign(triangles.begin(), triangles.end());
        now = before;
    }
};

/// Fields: the three components of the position. Results: one for each sense. `triangles` must have
/// an entry for each cell whenever the kernel runs. Positions after the last cell repeat it. The
/// kernel caches the last senses of the first `kept` cells, since several steps and rates read the
/// same positions. Throws std::bad_alloc.
KernelPointer make_sense_kernel(std::shared_ptr<const Surroundings> surroundings,
                                std::vector<Sense> senses, std::shared_ptr<NearTriangles> triangles,
                                std::int64_t kept = 0);

}  // namespace cascade
