// Detects parts of rates, and of rules at sides, that are lost in single precision: they are
// rounded to 0 or to infinity, or are too small to change a sum.
#pragma once

#include "core/run_control.h"
#include "run/simulation/stage_view.h"

namespace cascade {

/// Warns once for each stage if lost parts change its result. Does not warn on coarser grids,
/// because the full grid gives the same warnings.
class LostParts {
public:
    /// Must be called before the first step of a stage and at its end.
    void look(const StageView& view, const RunControl& control);
    bool are_told() const { return are_told_; }

private:
    bool are_told_ = false;
};

}  // namespace cascade
