// Checks of a chart: no overlaps, and little distortion.
#pragma once

#include "atlas/chart.h"

namespace cascade {

/// Whether no two parts of a flat chart overlap: all triangles are counterclockwise, no two edges
/// of its outline cross or touch, and one of its loops encloses all others. (A point is covered as
/// often as the sum of the loops' winding numbers around it.)
bool is_injective(const Seams& seams, const Chart& chart);

struct ChartStretch {
    double area = 0;   ///< The area on the surface.
    double mean = 0;   ///< The triangles' distortion, weighted by area.
    double worst = 0;  ///< The largest distortion.
    double bad = 0;    ///< The part of the area with a distortion beyond `bad_distortion`.
    static constexpr double bad_distortion = 1.5;
};
ChartStretch stretch_of(const SurfaceMesh& mesh, const Chart& chart);

}  // namespace cascade
