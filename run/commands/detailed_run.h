// `--detail`: the end of a run, carried to finer cells of the same domain, where it settles.
//
// The run itself, its log and what is saved of it are those of the script's own cells. Pictures,
// models and everything else that is written show the finer cells.
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
    /// Makes the finer cells and checks all that could be refused, before the run takes a step.
    /// `coarse` is a simulation of the script. Fails, too, if `control` cancels. `script`, which
    /// gets the errors, must outlive the result.
    static Result<std::unique_ptr<DetailedRun>> create(Script& script, const RunRequest& request,
                                                       const Simulation& coarse,
                                                       RunControl& control);

    /// Carries the run, whose stages have ended, and lets its last stage settle.
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
    std::vector<Painter> panels_;  ///< Of figures.
};

/// The painters of `--panel`. Errors go to `script.diagnostics`.
Result<std::vector<Painter>> panel_painters(Script& script, const RunRequest& request);

}  // namespace cascade
