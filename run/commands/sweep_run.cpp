// Takes the stages of a run one after the other. A log has the rows that `cascade run` would write.
#include "run/commands/sweep_run.h"

#include "run/commands/moments.h"
#include "run/commands/run.h"
#include "run/commands/run_log.h"
#include "run/pictures/measured.h"
#include "run/pictures/picture_remarks.h"
#include "run/simulation/end_remarks.h"

#include <algorithm>
#include <string>
#include <utility>

namespace cascade {

namespace {

/// Joins the lines of a text, so that it fits into a cell of the table.
std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

void add_remark(SweepResult& result, const std::string& words) {
    if (words.empty()) return;
    result.remark += (result.remark.empty() ? "" : "; ") + one_line(words);
}

Result<void> take_stages(const Script& script, const Moments& moments, Simulation& simulation,
                         RunControl& control, RunLog* log, SweepResult& result) {
    for (std::uint32_t k = 0; k < script.stage_count(); ++k) {
        if (auto started = simulation.start_stage(k, control.cancel); !started) {
            return control.cancel ? Result<void>() : started;
        }
        const Stage& stage = script.program->stages[k];
        std::function<void()> observe;
        if (log) observe = [&, k] { log->record(simulation, k); };
        if (observe) observe();
        auto end = simulation.advance_stage(k, stage.iterations, control, observe,
                                            log ? log->every(stage) : 0,
                                            moments_of(moments, simulation, k));
        if (observe) observe();
        result.steps += simulation.state(k).steps;
        if (!end) return tl::unexpected(end.error());
        if (*end == StageEnd::cancelled) return {};
        add_remark(result, remark_on(simulation, k));
    }
    return {};
}

/// Measures the end of a run and draws its tile.
void measure_end(const Simulation& simulation, Painter& painter, int tile_side,
                 SweepResult& result) {
    Canvas canvas = painter.canvas(simulation);
    add_remark(result, remark_on_picture(painter, simulation, canvas));
    result.features = measure_shown(painter, simulation);
    result.cells = counts_of_cells(simulation.state(shown_stage(simulation)));
    // Crawling cells have no rows and columns to be averaged, so their tile is a picture.
    painter.set_width(tile_side);
    if (canvas.cells || simulation.domain().model) canvas = canvas_of(painter.image(canvas));
    result.tile = shrink(canvas, tile_side);
}

}  // namespace

tl::expected<std::optional<SweepResult>, SweepError> take_run(
    const Script& base, const PlannedRun& run, const SweepRequest& request,
    const SimulationOptions& options, const std::filesystem::path& folder, RunControl& control) {
    const auto give_up = [](const Failure& why) { return tl::unexpected(SweepError{why}); };
    Script script = load(base, run);
    auto painter = Painter::create(script, request.picture);
    auto simulation = Simulation::create(script, options);
    if (!painter) return give_up(painter.error());
    if (!simulation) {
        const Failure why = simulation.error();
        // Errors in files that a script reads are reported at their names in the script.
        if (!script.diagnostics.has_errors()) return give_up(why);
        return tl::unexpected(SweepError{why, std::move(script)});
    }
    std::optional<RunLog> log;
    if (!request.log.expressions.empty()) {
        auto made = RunLog::create(script, request.log, request.picture);
        if (!made) return give_up(made.error());
        log = *std::move(made);
    }
    SweepResult result;
    control.warn = [&](const std::string& warning) { add_remark(result, warning); };
    const auto done = take_stages(script, *moments_in(script.tree, request.moments), **simulation,
                                  control, log ? &*log : nullptr, result);
    control.warn = {};
    if (control.cancel) return std::nullopt;
    if (log) result.log = log->table();
    if (!done) {
        result.remark = one_line(done.error().message);
        return result;
    }
    measure_end(**simulation, *painter, request.tile_side, result);
    if (!request.fields) return result;
    const auto saved =
        save_run(folder / "fields" / folder_name(request.varied, run.values), script, **simulation);
    if (!saved) return give_up(saved.error());
    return result;
}

}  // namespace cascade
