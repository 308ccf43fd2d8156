// The smaller cells belong to a second simulation of the same script, which is loaded again for it.
#include "run/commands/detailed_run.h"

#include "run/commands/run_checks.h"
#include "run/pictures/picture_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace cascade {

namespace {

/// Rewords the first error of the script with smaller cells as an error of the option --detail.
Failure refusal(Script& script, const Script& finer, int detail) {
    const std::vector<Diagnostic> all = finer.diagnostics.sorted();
    const auto error = std::find_if(all.begin(), all.end(), [](const Diagnostic& each) {
        return each.severity == Severity::error;
    });
    if (error != all.end()) {
        script.diagnostics.error(option_span(script.sources, "--detail", std::to_string(detail)),
                                 error->message, error->hint);
    }
    return {"the request does not fit the script", ""};
}

/// Returns the part of `limit` that is left for the smaller cells while the run's own cells use
/// `used` bytes. 0 means that memory is not limited.
std::uint64_t memory_left(std::uint64_t limit, double used) {
    if (limit == 0) return 0;
    return static_cast<std::uint64_t>(std::max(1.0, static_cast<double>(limit) - used));
}

}  // namespace

Result<std::vector<Painter>> panel_painters(Script& script, const RunRequest& request) {
    std::vector<Painter> panels;
    for (const std::string& expression : request.panels) {
        PictureRequest wanted = request.picture;
        wanted.show = expression;
        auto panel = Painter::create(script, wanted, "--panel");
        if (!panel) return tl::unexpected(panel.error());
        panels.push_back(std::move(*panel));
    }
    return panels;
}

Result<std::unique_ptr<DetailedRun>> DetailedRun::create(Script& script, const RunRequest& request,
                                                         const Simulation& coarse,
                                                         RunControl& control) {
    const int detail = request.picture.detail;
    std::unique_ptr<DetailedRun> made(new DetailedRun(script.detailed(detail)));
    Script& finer = made->script_;
    if (!finer.program) return tl::unexpected(refusal(script, finer, detail));
    finer.diagnostics = {};  // The messages in it were printed when the script was first loaded.

    SimulationOptions options = request.simulation;
    options.memory_limit = memory_left(options.memory_limit, coarse.domain().memory);
    options.control = &control;
    options.known_sizes = coarse.domain().known_sizes;
    // Messages about the model and about sizes have already been printed for the run's own cells.
    auto warn = std::exchange(control.warn, {}), note = std::exchange(control.note, {});
    auto simulation = Simulation::create(finer, options);
    control.warn = std::move(warn);
    control.note = std::move(note);
    if (!simulation && finer.diagnostics.has_errors())
        return tl::unexpected(refusal(script, finer, detail));
    if (!simulation) {
        Failure why = simulation.error();
        why.message = fmt::format("with --detail {}: {}", detail, why.message);
        return tl::unexpected(std::move(why));
    }
    made->simulation_ = std::move(*simulation);

    auto painter = Painter::create(finer, request.picture);
    if (!painter) return tl::unexpected(painter.error());
    made->painter_ = std::move(*painter);
    auto panels = panel_painters(finer, request);
    if (!panels) return tl::unexpected(panels.error());
    made->panels_ = std::move(*panels);
    auto fits = check_picture_size(finer, request.picture,
                                   coarse.domain().memory + made->simulation_->domain().memory,
                                   request.simulation.memory_limit);
    if (fits) fits = check_film_sizes(finer, request, control.cancel);
    if (!fits) return tl::unexpected(fits.error());
    return made;
}

Result<StageEnd> DetailedRun::settle(const Simulation& coarse, RunControl& control) {
    if (!coarse.state(0).started) return StageEnd::finished;
    const std::uint32_t stage = shown_stage(coarse);
    if (auto carried = simulation_->go_on_from(coarse, stage); !carried)
        return tl::unexpected(carried.error());
    if (coarse.state(stage).steps == 0) return StageEnd::finished;
    const std::int64_t last = simulation_->domain().stage(stage).iterations;
    return simulation_->advance_stage(stage, last, control, {});
}

}  // namespace cascade
