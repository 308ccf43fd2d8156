// The option `--detail` transfers the pattern at the end of a run to smaller cells of the same
// domain. The last stage then settles in these cells.
//
// The run itself, its log and the saved run use the script's own cells. Pictures, models and all
// other outputs show the smaller cells.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "run/commands/run.h"
#include "run/pictures/painter.h"

#include <memory>
#include <vector>

namespace cascade {

class DetailedRun {
public:
    /// Makes the smaller cells. Fails if something prevents them, so that a run is refused before
    /// its first step. `coarse` is a simulation of the script. Also fails if `control` cancels.
    /// Errors are added to `script.diagnostics`. `script` must outlive the result.
    static Result<std::unique_ptr<DetailedRun>> create(Script& script, const RunRequest& request,
                                                       const Simulation& coarse,
                                                       RunControl& control);

    /// Transfers the state of `coarse`, whose stages have ended, to the smaller cells, and lets the
    /// last stage settle there.
    Result<StageEnd> settle(const Simulation& coarse, RunControl& control);

    const Script& script() const { return script_; }
    Simulation& simulation() { return *simulation_; }
    Painter& painter() { return *painter_; }
    std::vector<Painter>& panels() { return panels_; }

private:
    DetailedRun(Script script) : script_(std::move(script)) {}

    Script script_;
    std::unique_ptr<Simulation> simulation_;
    std::optional<Painter> painter_;
    std::vector<Painter> panels_;  ///< One for each panel of a figure.
};

/// Makes a painter for each `--panel`. Errors are added to `script.diagnostics`.
Result<std::vector<Painter>> panel_painters(Script& script, const RunRequest& request);

}  // namespace cascade
