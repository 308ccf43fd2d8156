// Factors are stored under the text of the trial program, which consists of equations, parameters,
// start and solver.
#include "run/simulation/stage_sizes.h"

#include "core/check.h"
#include "core/decimal.h"
#include "core/kept_files.h"
#include "core/version.h"
#include "lang/program/scaled_lengths.h"
#include "lang/program/trial_program.h"
#include "run/domain/model_cells.h"
#include "run/simulation/size_trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

namespace cascade {

namespace {

/// The digit at the end of the second string must be changed whenever factors are found in another
/// way.
constexpr KeptFiles::Kind size_files{".size", "CascSiz1", std::uint64_t{1} << 20};

/// Stores factors by their keys. The factors that this process has found are in memory, and all
/// factors are also on disk.
class KeptFactors {
public:
    KeptFactors(const std::filesystem::path& folder, std::map<std::string, double>& known)
        : files_(folder, size_files), known_(known) {}

    std::optional<double> find(const std::string& key) {
        if (const auto known = known_.find(key); known != known_.end()) return known->second;
        const auto text = files_.find(key);
        if (!text) return std::nullopt;
        double factor = 0;
        const char* const end = text->data() + text->size();
        const auto read = from_decimal(text->data(), end, factor);
        if (read.ec != std::errc() || read.ptr != end || !(factor > 0)) return std::nullopt;
        known_[key] = factor;
        return factor;
    }

    void keep(const std::string& key, double factor) {
        known_[key] = factor;
        files_.keep(key, fmt::format("{}", factor));
    }

private:
    KeptFiles files_;
    std::map<std::string, double>& known_;
};

/// Returns the side of a square that has the area of the mean cell, in units of the domain.
double cell_width(const Environment& here) {
    const DomainSettings& domain = here.program->domain;
    if (here.model) {
        const SpreadCells& spread = here.model->cells->spread();
        double area = 0;
        for (const double each : spread.cells.areas) area += each;
        return std::sqrt(area / static_cast<double>(spread.cells.areas.size())) / spread.unit;
    }
    if (here.metric.empty()) return domain.grid.spacing;
    if (!domain.surface->unit && !domain.surface->extent)
        return 1.0 / static_cast<double>(domain.detail);
    const Field& areas = here.metric[static_cast<std::size_t>(MetricPlane::area)];
    double area = 0;
    for (std::int64_t row = 0; row < here.grid.height; ++row) {
        for (std::int64_t i = 0; i < here.grid.width; ++i) area += areas.number_at(i, row);
    }
    return std::sqrt(area / static_cast<double>(here.grid.cell_count()));
}

/// Returns the longest possible wave, in cells. On a grid it is as long as the longest side, and on
/// a model as long as the side of a square with as many cells as the model.
double longest_wave(const Environment& here) {
    if (!here.model) return static_cast<double>(here.grid.longest_side());
    return std::sqrt(static_cast<double>(here.model->cells->count()));
}

/// Returns the key of a trial. It does not depend on the end of the stage, because trials end by
/// their own rules.
std::string key_of(const Program& trial, std::uint32_t stage, double cell, double cells) {
    Program keyed = trial;
    const bool has_steps = !trial.stages[stage].time.has_duration();
    // The number of the stage's steps matters only if the trial takes more steps because of it.
    if (has_steps) keyed.stages[stage].iterations = trial_steps(trial, stage);
    keyed.stages[stage].interval = 0;
    // The trial has its own grid, so the stage's grid does not belong to the key.
    Grid& grid = keyed.domain.grid;
    grid.spacing = 1;
    for (std::int64_t* const side : {&grid.width, &grid.height, &grid.depth}) {
        *side = std::min<std::int64_t>(*side, 2);
    }
    return fmt::format("{}\n{} cells of {}\n{}", version(), cells, cell, print_program(keyed));
}

/// Returns the length of one unit of a model, in the script's unit of length.
double unit_in_scripts(const ModelSettings& model, const ModelCells& cells) {
    const double unit = model.unit ? *model.unit : cells.spread().unit;
    return unit / ModelBox(cells.mesh).longest;
}

}  // namespace

void size_cells(Environment& here, const ModelCells& cells, RunControl& control) {
    std::optional<Program> sized;
    for (std::uint32_t k = 0; k < here.program->stages.size(); ++k) {
        const Stage& stage = here.stage(k);
        if (!(stage.cell_size > 0)) continue;
        if (!sized) sized = *here.program;
        const double radius =
            stage.cell_size / 2 * unit_in_scripts(*here.program->domain.model, cells);
        const ItemId item = here.program->system_of(k).cells->radius;
        sized->stages[k].items[item] = {{Node{radius, stage.span}}};
        if (control.note) {
            control.note(fmt::format("stage '{}': cells of size {:g} start with r = {:.4g}",
                                     stage.name, stage.cell_size, radius));
        }
    }
    if (sized) here.use(*std::move(sized));
}

Result<void> find_sizes(Environment& here, Script& script, const SimulationOptions& options,
                        RunControl& control) {
    here.known_sizes = options.known_sizes;
    KeptFactors kept(options.kernel_cache, here.known_sizes);
    std::optional<Program> scaled;
    for (std::uint32_t k = 0; k < script.stage_count(); ++k) {
        const Stage& stage = here.stage(k);
        if (!stage.size) continue;
        const auto refuse = [&](const std::string& message, const std::string& hint) {
            script.diagnostics.error(stage.size->span, message, hint);
            return failure(fmt::format("stage '{}' cannot have its size", stage.name));
        };
        const auto times = static_cast<double>(stage.coarse);
        const double cell = cell_width(here) * times, cells = stage.size->wanted / cell;
        if (const auto unfit = unfit_size(*stage.size, cell, longest_wave(here) / times))
            return refuse(unfit->message, unfit->hint);
        const auto trial = trial_program(*here.program, k);
        CHECK(trial, "the checker refuses sizes without a trial");
        const std::string key = key_of(*trial, k, cell, cells);
        std::optional<double> factor = kept.find(key);
        if (!factor) {
            StepTools steps = here.tools;
            steps.tiling.reset();
            const TrialTools tools{script, std::move(steps), options.planning, control};
            const auto found = find_length_factor(*trial, k, cell, cells, tools);
            if (control.cancel) return failure("stopped while sizes were found");
            if (!found) return refuse(found.error().message, found.error().hint);
            factor = *found;
            kept.keep(key, *factor);
        }
        if (control.note) {
            control.note(
                fmt::format("stage '{}': all its lengths are multiplied by {}, so that its waves "
                            "become {:g} long instead of {:.3g}",
                            stage.name, *factor, stage.size->wanted, stage.size->wanted / *factor));
        }
        scaled = with_lengths(scaled ? *scaled : *here.program, k, *factor);
    }
    if (scaled) here.use(*std::move(scaled));
    return {};
}

bool has_sizes(const Script& script) {
    for (std::uint32_t k = 0; k < script.stage_count(); ++k) {
        if (script.program->stages[k].size) return true;
    }
    return false;
}

Result<std::shared_ptr<const Program>> sized_program(Script& script,
                                                     const SimulationOptions& options) {
    if (!has_sizes(script)) return script.program;
    const auto made = make_environment(script, options);
    if (!made) return tl::unexpected(made.error());
    return (*made)->program;
}

}  // namespace cascade
