// Everything that all stages of a simulation share and do not change: the domain, files, plans,
// kernels and threads.
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

/// The additional tools for stages of crawling cells.
struct CrawlingTools {
    KernelMaker kernels;
    /// The surroundings of the crawling cells. A stage may replace them by a body that it grows.
    std::shared_ptr<const TissueGround> ground;
};

class Environment : public SimulationDomain {
    TimeAccount unread_;  ///< Receives the times if the caller gives no account.

public:
    /// `its_plans` are the plans of the program. If `kernel_cache` is not empty, the fastest
    /// tilings are stored in that folder. `of` and `times` must outlive the environment. `times`
    /// may be null.
    Environment(const Script& of, std::shared_ptr<const Program> runs, StagePlans its_plans,
                const Grid& in, StepTools with, TimeAccount* times = nullptr,
                const std::filesystem::path& kernel_cache = {});

    const Script& script;
    /// Text that is appended to the stage's name in reports of progress.
    std::string progress_note;
    InputFiles files;
    std::vector<Field> metric;  ///< Indexed by MetricPlane. Empty if the domain has no surface.
    StepTools tools;
    KernelMaker kernels;
    std::optional<CrawlingTools> crawling;  ///< Empty if all stages are of fields.
    // The following members are mutable because they are caches or tools. No result depends on how
    // they were used before.
    mutable StagePlans plans;
    mutable KeptTilings tilings;
    mutable Team team;  ///< Computes starting values and pictures.
    TimeAccount& account;

    /// Replaces the program with another program for the same domain.
    void use(Program other);
    /// Whether this is the program of the script itself, with the same cells and unscaled lengths.
    bool runs_as_written() const { return program == script.program; }
    /// Returns the facts about the model, or null on grids. Makes the model's cells if they do not
    /// exist yet.
    const ModelFacts* model_facts() const { return model ? &model->cells->spread() : nullptr; }
    /// Returns a mask of the cells that belong to the domain or model. Returns null if all cells of
    /// the grid do.
    const Mask* counted() const {
        return mask ? &mask->inside : model ? &model->cells->spread().inside : nullptr;
    }
    /// Whether the steps of a stage will certainly take longer than compiling their kernels.
    bool takes_long(std::uint32_t k) const;
    /// Describes a cell for messages: by its column and row or, on a model, by its number.
    std::string place_in_words(std::int64_t column, std::int64_t row) const;
};

/// Checks memory, reads files, makes the cells of a model and computes the mask. If a file has
/// errors, adds them to `script.diagnostics` and fails. `script` must outlive the environment.
Result<std::unique_ptr<Environment>> make_environment(Script& script,
                                                      const SimulationOptions& options);

}  // namespace cascade
