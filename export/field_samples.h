// Samples of the cells that cover a surface, for baking.
#pragma once

#include "export/painted_cells.h"
#include "export/sample_painter.h"

#include <vector>

namespace cascade {

/// Paints the pattern of cells, with the bumps of their heights if there are any. The arguments
/// must outlive the painter.
///
/// Filtered values vary smoothly within a triangle, but thresholds and positions make colours jump.
/// So filtered values are computed only at some samples of a row, the knots, and interpolated
/// between them. The colour is computed for every sample.
class FieldSamples : public SamplePainter {
public:
    FieldSamples(const SurfaceMesh& mesh, const CellFilter& filter, const PaintedCells& cells);

    MapSet maps() const override { return maps_of(cells_.material, !cells_.heights.empty()); }
    void paint(const SampleRow& row) override;
    /// Computes the normal at the middle sample only.
    Vector3d raised_normal(std::span<const SurfacePlace> samples, const Vector3d& normal) override;

private:
    std::size_t steps_of(const SurfacePlace& one, const SurfacePlace& other) const;

    const SurfaceMesh& mesh_;
    const CellFilter& filter_;
    const PaintedCells& cells_;
    PlacePainter painter_;
    std::vector<float> here_, there_;  ///< Filtered values at two knots.
    std::vector<float> between_;       ///< Filtered values between the knots.
};

}  // namespace cascade
