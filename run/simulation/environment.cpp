// Makes everything that stages share. This is done only once, before any stage starts.
#include "run/simulation/environment.h"

#include "lang/program/stage_kinds.h"
#include "run/domain/field_values.h"
#include "run/domain/metric_planes.h"
#include "run/domain/deadline.h"
#include "run/simulation/stage_sizes.h"
#include "run/simulation/stage_view.h"
#include "run/simulation/undefined_values.h"
#include "run/stage/memory.h"
#include "run/stage/plan_runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace cascade {
namespace {

/// Returns all calls of disc, ring and box with constant arguments as separate formulas. Each call
/// occurs once.
std::vector<Formula> written_areas(const Program& program) {
    std::vector<Formula> areas;
    for (const Formula* formula : formulas_of(program)) {
        for (const Node& node : formula->nodes) {
            if (!node.is<Call>()) continue;
            if (node.function != Function::disc && node.function != Function::ring &&
                node.function != Function::box) {
                continue;
            }
            Formula area;
            Node call = node;
            for (NodeId& operand : call.reads()) {
                const Node& number = formula->nodes[operand];
                operand = area.nodes.next();
                area.nodes.push_back(number);
            }
            const bool is_known =
                std::all_of(area.nodes.begin(), area.nodes.end(),
                            [](const Node& number) { return number.is<double>(); });
            const bool is_new = std::none_of(areas.begin(), areas.end(), [&](const Formula& other) {
                return other.nodes.back().span == call.span;
            });
            area.nodes.push_back(call);
            if (is_known && is_new) areas.push_back(std::move(area));
        }
    }
    return areas;
}

/// Makes the cells of the script's model, or takes them from another simulation with the same
/// model.
Result<std::shared_ptr<const ModelCells>> make_cells(Script& script,
                                                     const SimulationOptions& options, int threads,
                                                     RunControl& control) {
    const TimeAccount::Scope spent(options.account, Spent::cells);
    if (options.known_model) return options.known_model;
    Team makers(threads);
    // Whether `check_model` or a missing attribute refused the model. No further message is then
    // needed.
    bool is_refused = false;
    const auto check = [&](const SurfaceMesh& mesh) {
        Result<void> good = options.check_model ? options.check_model(mesh) : Result<void>();
        if (good) good = check_attributes(script, mesh);
        is_refused = !good;
        return good;
    };
    const ModelAccess access{script.folder,
                             script.overrides.reads,
                             script.overrides.model_is_asked_for,
                             options.cell_cache,
                             check,
                             !has_stage_of_fields(*script.program)};
    Deadline deadline(options.model_seconds, control.cancel);
    auto made = make_model_cells(*script.program, access, makers, control);
    if (deadline.ends_work()) {
        script.diagnostics.error(
            script.program->domain.model->span,
            fmt::format("the cells of the model were not finished after {} s",
                        options.model_seconds),
            "use fewer 'cells', or a model with fewer triangles: 'cascade mesh MODEL --simplify "
            "50000 -o simple.ply'");
        return failure("the model takes too long");
    }
    if (control.cancel) return failure("stopped while the cells of the model were made");
    if (is_refused) return tl::unexpected(made.error());
    if (!made) {
        script.diagnostics.error(script.program->domain.model->span, made.error().message,
                                 made.error().hint);
        return failure("the model cannot be used");
    }
    if (control.warn) {
        for (const std::string& repair : (*made)->repairs)
            control.warn("the model was repaired: " + repair);
    }
    return std::move(*made);
}

/// Makes a model the domain. Computes the values that formulas of the program read at positions on
/// the model.
Result<void> take_model(Environment& here, std::shared_ptr<const ModelCells> cells,
                        const RunControl& control) {
    const TimeAccount::Scope spent(here.account, Spent::cells);
    auto values = std::make_unique<SurfaceValues>(*here.program, *cells, here.team);
    here.model.emplace(std::move(cells), std::move(values));
    here.model->values->make(formulas_of(*here.program), control.cancel);
    if (control.cancel) return failure("stopped while distances on the model were found");
    if (here.program->stages.empty() || !control.warn) return {};
    const std::vector<StageState> states(1);
    // A shape whose numbers were chosen for one model may contain no cell of another model.
    for (const Formula& area : written_areas(*here.program)) {
        const StageView view(here, states, 0);
        if (largest_value(view.evaluate(area)[0], nullptr) > 0) continue;
        control.warn(fmt::format("no cell of the model lies in {}",
                                 here.script.sources.text(area.nodes.back().span)));
    }
    return {};
}

/// Computes the mask before the first stage. The mask does not change afterwards.
Result<void> find_mask(Environment& here, Script& script, const RunControl& control) {
    const auto& mask = here.program->domain.mask;
    if (!mask || here.program->stages.empty()) return {};
    const TimeAccount::Scope spent(here.account, Spent::starting);
    const std::vector<StageState> states(1);
    const StageView view(here, states, 0);
    const auto evaluate = [&](const StepPlan& plan) {
        return std::move(
            run_plan(plan, here.kernels.interpreted(), view.context(), here.grid, here.team)[0]);
    };
    const Field values = evaluate(plan_mask(*here.program));
    if (control.warn) warn_of_undefined_mask(here, evaluate, control);
    here.mask = make_domain_mask(values, here.grid);
    if (here.mask->cells == here.grid.cell_count() && control.warn) {
        control.warn("the mask of the domain leaves no cell out: it is nowhere 0");
    }
    if (here.mask->cells > 0) return {};
    script.diagnostics.error(mask->span, "no cell is inside the mask",
                             "cells where the mask is not 0 belong to the domain");
    return failure("the domain has no cells");
}

/// Makes everything that is needed to evaluate formulas of the program: the values of a model, the
/// ground of crawling cells, sizes, and the mask. `cells` may be null.
Result<void> make_whole(Environment& here, Script& script, const SimulationOptions& options,
                        std::shared_ptr<const ModelCells> cells, RunControl& control) {
    if (cells) {
        if (auto taken = take_model(here, cells, control); !taken) return taken;
    }
    if (has_stage_of_cells(*here.program)) {
        constexpr std::int64_t usual_cells = 4096;
        here.crawling.emplace(KernelMaker(rows_of_cells(usual_cells), here.tools, here.account),
                              std::make_shared<TissueGround>(here.grid, cells.get()));
    }
    if (cells) size_cells(here, *cells, control);
    if (auto found = find_sizes(here, script, options, control); !found) return found;
    warn_of_uniform_pictures(here, control);
    return find_mask(here, script, control);
}

}  // namespace

Environment::Environment(const Script& of, std::shared_ptr<const Program> runs,
                         StagePlans its_plans, const Grid& in, StepTools with, TimeAccount* times,
                         const std::filesystem::path& kernel_cache)
    : SimulationDomain{std::move(runs), in},
      script(of),
      tools(std::move(with)),
      kernels(in, tools, times != nullptr ? *times : unread_),
      plans(std::move(its_plans)),
      tilings(kernel_cache, tools.stepper->code_identity()),
      team(kernels.is_small() ? 1 : tools.threads),
      account(times != nullptr ? *times : unread_) {}

void Environment::use(Program other) {
    program = std::make_shared<const Program>(std::move(other));
    plans = StagePlans(*program, plans.options());
}

bool Environment::takes_long(std::uint32_t k) const {
    const StageTime& time = stage(k).time;
    const bool is_counted = !time.open_end && !time.has_duration() && !time.steady && !time.until;
    return is_counted && stage(k).iterations >
                             cells_worth_compiling / std::max<std::int64_t>(1, grid.cell_count());
}

std::string Environment::place_in_words(std::int64_t column, std::int64_t row) const {
    if (!model) return fmt::format("column {}, row {}", column, row);
    // In the padding of the grid, the last cell is repeated.
    const ModelCells& cells = *model->cells;
    const auto last = static_cast<std::int64_t>(cells.count()) - 1;
    return fmt::format("cell {}", cells.cell_at(std::min(row * grid.width + column, last)));
}

Result<std::unique_ptr<Environment>> make_environment(Script& script,
                                                      const SimulationOptions& options) {
    CHECK(script.program, "only a checked script is simulated");
    RunControl unwatched;
    RunControl& control = options.control != nullptr ? *options.control : unwatched;
    const Program& program = *script.program;
    StepTools tools{options.stepper, options.starts_interpreted,
                    options.threads > 0 ? options.threads : hardware_threads(), options.tiling,
                    options.executor};
    for (std::uint32_t k = 0; options.account != nullptr && k < script.stage_count(); ++k) {
        options.account->stage(k).name = program.stages[k].name;
    }
    StagePlans plans(program, options.planning);
    Grid grid = program.domain.grid;
    double memory = 0;
    const auto fits_memory = [&](const ModelFacts* facts) {
        const TimeAccount::Scope spent(options.account, Spent::compiling);
        memory = memory_of(program, plans, facts);
        return check_memory(grid, memory, options.memory_limit);
    };
    // The number of faces or vertices of a model is known only after the model has been read.
    const auto& model = program.domain.model;
    if (!model || model->cells == ModelCellKind::spread) {
        if (auto fits = fits_memory(nullptr); !fits) return tl::unexpected(fits.error());
    }
    std::shared_ptr<const ModelCells> cells;
    if (model) {
        auto made = make_cells(script, options, tools.threads, control);
        if (!made) return tl::unexpected(made.error());
        cells = std::move(*made);
        grid = cells->grid();
        // Crawling cells do not need the cells of the model, so these are then made only on demand.
        auto fits = fits_memory(has_stage_of_fields(program) ? &cells->spread() : nullptr);
        if (!fits) return tl::unexpected(fits.error());
    }
    auto files = [&] {
        const TimeAccount::Scope spent(options.account, Spent::reading);
        return read_input_files(script, cells.get());
    }();
    if (!files) return tl::unexpected(files.error());
    auto metric = metric_planes(program);
    if (!metric) return tl::unexpected(metric.error());
    if (!tools.stepper) {
        const TimeAccount::Scope spent(options.account, Spent::compiling);
        auto own = make_stepper(options);
        if (!own) return tl::unexpected(own.error());
        tools.stepper = std::move(*own);
    }
    auto made =
        std::make_unique<Environment>(script, script.program, std::move(plans), grid,
                                      std::move(tools), options.account, options.kernel_cache);
    Environment& here = *made;
    here.memory = memory;
    here.files = std::move(*files);
    here.metric = std::move(*metric);
    if (auto whole = make_whole(here, script, options, std::move(cells), control); !whole)
        return tl::unexpected(whole.error());
    return made;
}

}  // namespace cascade
