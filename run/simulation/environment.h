// What the stages of a simulation share and do not change: its domain, files, plans, kernels,
// threads.
#pragma once

#include "core/parallel.h"
#include "core/plane.h"
#include "core/result.h"
#include "run/domain/input_files.h"
#include "run/script/script.h"
#include "run/simulation/kernel_maker.h"
#include "run/simulation/simulation.h"
#include "run/simulation/simulation_domain.h"
#include "run/stage/kept_tilings.h"
#include "run/stage/stage_plans.h"
#include "run/stage/stage_state.h"
#include "run/tissue/ground.h"
#include "solvers/executor.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cascade {

struct Environment : SimulationDomain {
    const Script* script = nullptr;
    std::string progress_note;  ///< After the stage's name in reports of progress.
    int threads = 1;
    MakeExecutor executor = make_thread_executor;
    std::optional<Tiling> tiling;          ///< None: chosen by size.
    std::unique_ptr<KeptTilings> tilings;  ///< Null on coarser grids.
    std::unique_ptr<StagePlans> plans;
    std::unique_ptr<KernelMaker> kernels;
    std::unique_ptr<KernelMaker> tissue_kernels;  ///< Of stages of cells that crawl,
    std::shared_ptr<TissueGround> ground;         ///< and where they do; else null.
    std::unique_ptr<Team> team;                   ///< Computes starting values and pictures.
    InputFiles files;
    std::vector<Field> metric;       ///< By MetricPlane; empty without a surface.
    TimeAccount* account = nullptr;  ///< Null if times are not recorded.

    /// Is the program the script's own, in its own cells and with its own lengths?
    bool runs_as_written() const { return program == script->program; }
    /// Of a model, whose cells this makes if they are not yet; null on grids.
    const ModelFacts* model_facts() const { return model ? &model->cells->spread() : nullptr; }
    /// The cells that count, with a mask or on a model.
    const Mask* counted() const {
        return mask ? &mask->inside : model ? &model->cells->spread().inside : nullptr;
    }
    /// Do the steps of a stage certainly take longer than compiling them?
    bool takes_long(std::uint32_t k) const;
    /// The column and row of a cell, or the number of one of a model.
    std::string place_in_words(std::int64_t column, std::int64_t row) const;
};

/// Checks memory, reads files, makes the cells of a model and computes the mask. Faults of files
/// are added to `script.diagnostics`, and the result fails. `script` must outlive the environment.
Result<std::unique_ptr<Environment>> make_environment(Script& script,
                                                      const SimulationOptions& options);

}  // namespace cascade
