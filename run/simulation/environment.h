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
#include "run/stage/time_account.h"
#include "run/tissue/ground.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// What stages of cells that crawl need besides.
struct CrawlingTools {
    KernelMaker kernels;
    std::shared_ptr<const TissueGround> ground;  ///< Where no body is grown.
};

class Environment : public SimulationDomain {
    TimeAccount unread_;  ///< Takes the times that nobody asked for.

public:
    /// `plans` are those of the program. The fastest tilings are kept in `kernel_cache`, if that is
    /// not empty. Script and account, which may be null, must outlive the environment.
    Environment(const Script& of, std::shared_ptr<const Program> runs, StagePlans its_plans,
                const Grid& in, StepTools with, TimeAccount* times = nullptr,
                const std::filesystem::path& kernel_cache = {});

    const Script& script;
    std::string progress_note;  ///< After the stage's name in reports of progress.
    InputFiles files;
    std::vector<Field> metric;  ///< By MetricPlane; empty without a surface.
    StepTools tools;
    KernelMaker kernels;
    std::optional<CrawlingTools> crawling;  ///< None if all stages are of fields.
    // These remember and work; no result depends on what they did before.
    mutable StagePlans plans;
    mutable KeptTilings tilings;
    mutable Team team;  ///< Computes starting values and pictures.
    TimeAccount& account;

    /// Replaces the program by a similar one.
    void use(Program other);
    /// Is the program the script's own, in its own cells and with its own lengths?
    bool runs_as_written() const { return program == script.program; }
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
