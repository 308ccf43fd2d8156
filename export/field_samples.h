// Baked samples of cells that cover a surface.
#pragma once

#include "export/painted_cells.h"
#include "export/sample_painter.h"

#include <vector>

namespace cascade {

/// Paints the pattern of cells, bumped by their heights if there are any. The arguments must
/// outlive it.
///
/// Filtered values vary smoothly within a triangle, but thresholds and positions make colours jump.
/// So the filter is queried at knots along a row of samples, its values are interpolated, and every
/// sample gets a colour of its own.
class FieldSamples : public SamplePainter {
public:
    FieldSamples(const SurfaceMesh& mesh, const CellFilter& filter, const PaintedCells& cells);

    MapSet maps() const override { return maps_of(cells_.material, !cells_.heights.empty()); }
    void paint(const SampleRow& row) override;
    /// The middle sample represents all.
    Vector3d raised_normal(std::span<const SurfacePlace> samples, const Vector3d& normal) override;

private:
    std::size_t steps_of(const SurfacePlace& one, const SurfacePlace& other) const;

    const SurfaceMesh& mesh_;
    const CellFilter& filter_;
    const PaintedCells& cells_;
    PlacePainter painter_;
    std::vector<float> here_, there_;  ///< Filtered values at two knots,
    std::vector<float> between_;       ///< and between them.
};

}  // namespace cascade
