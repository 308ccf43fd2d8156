// Checks a chart: no overlaps, and little distortion.
#pragma once

#include "atlas/chart.h"

namespace cascade {

/// Whether no two parts of a flat chart overlap. That is the case if all triangles are
/// counterclockwise, no two edges of the outline cross or touch, and one loop of the outline
/// encloses all others. (The number of times that a point is covered is the sum of the loops'
/// winding numbers around it.)
bool is_injective(const Seams& seams, const Chart& chart);

struct ChartStretch {
    double area = 0;   ///< The area on the surface.
    double mean = 0;   ///< The mean distortion of the triangles, weighted by area.
    double worst = 0;  ///< The largest distortion.
    double bad = 0;    ///< The fraction of the area with a distortion above `bad_distortion`.
    static constexpr double bad_distortion = 1.5;
};
ChartStretch stretch_of(const SurfaceMesh& mesh, const Chart& chart);

}  // namespace cascade
