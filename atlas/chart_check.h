// What is asked of a chart: no overlaps, and little distortion.
#pragma once

#include "atlas/chart.h"

namespace cascade {

/// Whether no two parts of a flat chart overlap: all triangles are counterclockwise, no two edges
/// of its outline cross or touch, and one of its loops encloses all others. (The number of times
/// that a point is covered is the sum of the loops' winding numbers around it.)
bool is_injective(const Seams& seams, const Chart& chart);

struct ChartStretch {
    double area = 0;   ///< On the surface.
    double mean = 0;   ///< Of the triangles' distortion, weighted by their areas.
    double worst = 0;  ///< The largest of them.
    double bad = 0;    ///< The part of the area whose distortion is beyond `bad_distortion`.
    static constexpr double bad_distortion = 1.5;
};
ChartStretch stretch_of(const SurfaceMesh& mesh, const Chart& chart);

}  // namespace cascade
