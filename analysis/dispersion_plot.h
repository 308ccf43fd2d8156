// The diagram of a dispersion relation: growth by wave number.
#pragma once

#include "analysis/stage_analysis.h"
#include "picture/drawing.h"

namespace cascade::analysis {

/// Shows state_to_show() without waves far shorter than the growing ones: the real part of the
/// largest rate, its imaginary part if it has one, the next rate, the band that grows and its
/// fastest wave.
Drawing plot_dispersion(const StageAnalysis& analysis);

}  // namespace cascade::analysis
