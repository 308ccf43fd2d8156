// Products of rates that single precision takes for 0 or for infinite.
#pragma once

#include "core/run_control.h"
#include "run/simulation/stage_view.h"

namespace cascade {

/// Warns of them once in a stage that is run, if they would change its result. Coarser grids are
/// skipped, because they would repeat the warnings of the full grid.
class LostProducts {
public:
    /// Called before the first step of a stage and at its end.
    void look(const StageView& view, const RunControl& control);
    bool are_told() const { return are_told_; }

private:
    bool are_told_ = false;
};

}  // namespace cascade
