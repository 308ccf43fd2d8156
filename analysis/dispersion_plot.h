// The diagram of a dispersion relation: growth by wave number.
#pragma once

#include "analysis/stage_analysis.h"
#include "picture/drawing.h"

namespace cascade::analysis {

/// Draws the dispersion relation of the state that state_to_show() chooses: the real part of the
/// largest rate, its imaginary part if it is not 0, the next rate, the band of growing waves and
/// the fastest wave in it. Leaves out waves far shorter than the growing ones.
Drawing plot_dispersion(const StageAnalysis& analysis);

}  // namespace cascade::analysis
