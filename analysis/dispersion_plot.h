// The diagram of a dispersion relation: growth by wave number.
#pragma once

#include "analysis/stage_analysis.h"
#include "picture/drawing.h"

namespace cascade::analysis {

/// Of state_to_show(). Waves far shorter than those that grow are left out. Shows the real part of
/// the largest rate, its imaginary part if it has one, the next rate, the band that grows and its
/// fastest wave.
Drawing plot_dispersion(const StageAnalysis& analysis);

}  // namespace cascade::analysis
