// Plans a sweep: finds the values and scripts of its runs, and checks whether the result can be
// drawn.
#include "run/commands/sweep_plan.h"

#include "run/commands/ensemble.h"
#include "run/commands/run.h"
#include "run/commands/sweep_data.h"
#include "run/pictures/painter.h"
#include "run/script/embedded_script.h"
#include "run/stage/memory.h"

#include <fmt/format.h>

#include <optional>
#include <system_error>
#include <utility>

namespace cascade {

namespace {

using Planned = tl::expected<void, SweepError>;

/// Checks that the picture of a run can be drawn, and that its log can be written.
Planned check_outputs(Script script, const SweepRequest& request) {
    if (script.program->stages.empty()) {
        return tl::unexpected(
            SweepError{{"this script has no stage to run", example_of_stage(*script.program)}});
    }
    auto good = Painter::create(script, request.picture).map([](const Painter&) {});
    if (good && !request.log.expressions.empty()) {
        RunRequest run;
        run.log = request.log;
        run.moments = request.moments;
        check_moments(script, run);
        if (script.diagnostics.has_errors())
            return tl::unexpected(SweepError{{}, std::move(script)});
        good = RunLog::create(script, request.log, request.picture).map([](const RunLog&) {});
    }
    if (good && !request.data.empty()) good = check_sweep_data(script, request);
    if (good) return {};
    SweepError error{good.error()};
    if (script.diagnostics.has_errors()) error.script = std::move(script);
    return tl::unexpected(std::move(error));
}

/// Returns a hint on how to vary the grid, which --set cannot change. Returns an empty text for
/// other names.
std::string_view hint_of_domain(std::string_view name) {
    if (name == "grid") return "write let n = 64 and grid: n, n in the script, and --vary n=32,64";
    return "";
}

/// Returns the first error that the value of a varied name has caused.
std::optional<Failure> fault_in(const PlannedRun& run, const SweepRequest& request,
                                const Script& script) {
    const std::vector<std::string> names = names_of(request.varied);
    for (const Diagnostic& each : script.diagnostics.sorted()) {
        if (each.severity != Severity::error) continue;
        const std::string_view text = script.sources[each.span.source].text();
        for (std::size_t k = 0; k < names.size(); ++k) {
            const std::string set = fmt::format("{}={}", names[k], run.values[k]);
            if (text != set) continue;
            const bool has_note = each.hint.empty() && !each.notes.empty();
            const std::string_view by_name = hint_of_domain(names[k]);
            return Failure{fmt::format("--vary {}: {}", set, each.message),
                           !by_name.empty() ? std::string(by_name)
                           : has_note       ? each.notes[0].message
                                            : each.hint};
        }
    }
    return std::nullopt;
}

/// What the runs log and when. Empty without a log.
std::string text_of_log(const SweepRequest& request) {
    const LogRequest& log = request.log;
    const MomentsRequest& moments = request.moments;
    if (log.expressions.empty()) return "";
    return fmt::format("{}\n{}\n{} {}\n{} {}", fmt::join(log.expressions, "\n"), log.every,
                       fmt::join(moments.at.numbers, ","), moments.at.unit,
                       fmt::join(moments.every.numbers, ","), moments.every.unit);
}

Planned plan_run(const Script& base, const SweepRequest& request, std::size_t number,
                 SweepPlan& plan) {
    PlannedRun& run = plan.runs[number];
    run.values = values_of_run(request.varied, number);
    auto overrides = overrides_of_run(base.overrides, request.varied, run.values);
    if (!overrides) return tl::unexpected(SweepError{overrides.error()});
    run.overrides = std::move(*overrides);
    Script script = load(base, run);
    if (!script.program) {
        auto fault = request.sets ? fault_in(*request.sets, script, number) : std::nullopt;
        if (!fault) fault = fault_in(run, request, script);
        if (fault) return tl::unexpected(SweepError{*fault, std::nullopt, true});
        return tl::unexpected(
            SweepError{{"a script of the sweep is wrong", ""}, std::move(script)});
    }
    run.key = key_of_run(script, request.picture, request.tile_side, text_of_log(request));
    const std::shared_ptr<const Program> program = script.program;
    if (plan.own.empty()) {
        plan.memory_of_a_run = memory_of(*program);
        plan.first = program;
        if (auto good = check_outputs(std::move(script), request); !good) return good;
    }
    const double spacing = plan.first->domain.grid.spacing;
    plan.has_one_spacing = plan.has_one_spacing && program->domain.grid.spacing == spacing;
    if (!request.data.empty() && !have_same_shape(*plan.first, *program)) {
        return tl::unexpected(
            SweepError{{"--data needs runs with the same number of cells and the same precision",
                        "leave these out of --vary, or save the runs with --fields"}});
    }
    plan.own.push_back(number);
    return {};
}

Result<void> check_curves(const SweepRequest& request) {
    for (const std::string& number : request.curves) {
        if (auto good = check_curve(number, request.varied); !good) return good;
    }
    return {};
}

/// Checks --part and --gather: refuses too many parts, outputs that such a sweep cannot write, and
/// folders without results.
Result<void> check_division(const SweepRequest& request, std::size_t runs) {
    if (request.part.count > runs) {
        return failure(fmt::format("{} parts are too many for the {} runs of the sweep",
                                   request.part.count, runs),
                       fmt::format("use --part 1/{} at most", runs));
    }
    if (!request.part.is_all() && !request.film.empty()) {
        return failure("a part of a sweep cannot write a film",
                       "run the same command without --part when all parts are done");
    }
    if (!request.part.is_all() && !request.curves.empty()) {
        return failure("a part of a sweep cannot draw a curve",
                       "run the same command without --part when all parts are done");
    }
    if (!request.part.is_all() && !request.data.empty()) {
        return failure("a part of a sweep cannot write the file of --data",
                       "use --fields here, and run the same command without --part but with --data "
                       "when all parts are done");
    }
    if (request.fields && !request.gathered.empty()) {
        const std::string option = request.data.empty() ? "--fields" : "--data";
        return failure(
            fmt::format("{} cannot be used with --gather, which copies results without fields",
                        option),
            fmt::format("leave {} out: the fields stay in their folders", option));
    }
    for (const auto& folder : request.gathered) {
        std::error_code error;
        if (std::filesystem::is_directory(folder / "runs", error)) continue;
        return failure(fmt::format("'{}' holds no results of a sweep", folder.string()),
                       "name a folder that 'cascade sweep' has written");
    }
    return {};
}

}  // namespace

Script load(const Script& script, const PlannedRun& run) {
    return load_script(script.name, script.text, script.folder, run.overrides);
}

tl::expected<SweepPlan, SweepError> plan_sweep(const Script& script, const SweepRequest& request) {
    const auto count = count_runs(request.varied);
    if (!count) return tl::unexpected(SweepError{count.error()});
    // The sheet is a single picture in memory, so its size is limited.
    constexpr double most_pixels = 1 << 27;
    const double pixels = static_cast<double>(*count) * request.tile_side * request.tile_side;
    if (pixels > most_pixels) {
        return tl::unexpected(
            SweepError{{fmt::format("a sheet of {} tiles of {} × {} pixels is too large", *count,
                                    request.tile_side, request.tile_side),
                        "make the tiles smaller with --tile"}});
    }
    auto good = check_division(request, *count).and_then([&] { return check_curves(request); });
    if (!good) return tl::unexpected(SweepError{good.error()});
    SweepPlan plan;
    plan.runs.resize(*count);
    for (std::size_t number = 0; number < *count; ++number) {
        if (!request.part.has(number)) continue;
        if (auto planned = plan_run(script, request, number, plan); !planned) {
            return tl::unexpected(std::move(planned.error()));
        }
    }
    return plan;
}

}  // namespace cascade
