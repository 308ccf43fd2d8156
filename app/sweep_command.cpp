// The command `cascade sweep` runs a script with many values, shows progress, and reports the
// written files.

#include "app/commands.h"
#include "app/exit_status.h"
#include "app/interrupt.h"
#include "app/json_answer.h"
#include "app/last_moments.h"
#include "app/limits.h"
#include "app/option_values.h"
#include "app/progress_display.h"
#include "app/rank_process.h"
#include "core/counted.h"
#include "core/with_commas.h"
#include "ranks/launcher.h"
#include "ranks/ranks.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>

namespace cascade {

namespace {

/// Summarises a sweep: "81 runs (12 done before), 2,430,000 steps in 41.20 s", or "part 3 of 100:
/// 27 runs …".
std::string summary(const SweepReport& report, const SweepPart& part) {
    std::string text;
    if (!part.is_all()) text = fmt::format("part {} of {}: ", part.number, part.count);
    text += counted(report.runs, "run");
    if (report.done_before > 0)
        text += fmt::format(" ({} done before)", with_commas(report.done_before));
    if (report.steps > 0) {
        text += fmt::format(", {} steps in {:.2f} s", with_commas(report.steps), report.seconds);
    }
    return text + "\n";
}

int tell(const SweepReport& report, const Options& options, int signal, bool limit_reached,
         Console& console) {
    const SweepPart& part = options.sweep.part;
    if (JsonAnswer* const all = console.answer()) {
        (*all)["part"] = part.number;
        (*all)["parts"] = part.count;
        (*all)["runs"] = report.runs;
        (*all)["done_before"] = report.done_before;
        (*all)["failed"] = report.failed;
        (*all)["missing"] = report.missing;
        (*all)["steps"] = report.steps;
        (*all)["seconds"] = report.seconds;
        (*all)["written"] = nlohmann::ordered_json::array();
        for (const auto& path : report.written) (*all)["written"].push_back(path.string());
    }
    if (!options.quiet) {
        for (const auto& path : report.written) {
            console.print(fmt::format("wrote {}\n", path.string()));
        }
        console.say(summary(report, part));
    }
    if (report.missing > 0) {
        const std::string why = limit_reached
                                    ? fmt::format("the limit of {} is reached",
                                                  describe_duration(options.limit_seconds))
                                    : std::string("interrupted");
        console.say(fmt::format("cascade: {}; {} of {} are done, and the same command continues\n",
                                why, with_commas(report.runs - report.missing),
                                counted(report.runs, "run")));
        return limit_reached ? exit_status::time_limit : exit_status::signal_base + signal;
    }
    if (report.failed == 0) return exit_status::success;
    console.fail({fmt::format("{} of {} failed: {}", with_commas(report.failed),
                              counted(report.runs, "run"), report.first_failure),
                  part.is_all()
                      ? "features.csv gives the reason for each"
                      : "features.csv gives the reason for each, when all parts are done"});
    return exit_status::failed_run;
}

/// Returns the variations that options give. If there are no such options, returns the variations
/// stored in `file`, which is then the sheet of an earlier sweep.
Result<std::vector<Variation>> variations(const Options& options, const LoadedFile& file) {
    std::vector<Variation> varied = options.sweep.varied;
    if (options.sweep_seeds) varied.push_back(*options.sweep_seeds);
    if (!varied.empty() || !options.sweep_sets.empty()) return varied;
    for (const std::string& text : file.varied) {
        auto variation = parse_variation(text);
        if (!variation) return tl::unexpected(variation.error());
        varied.push_back(std::move(*variation));
    }
    if (!varied.empty()) return varied;
    return failure("nothing is varied",
                   "add --vary, as in --vary feed=0.02..0.06:9, --sets FILE.csv or --seeds 1..20");
}

int sweep_script(const Options& options, Console& console, Ranks* ranks) {
    auto file = load(options.scripts[0], options.overrides, console, typed_of(options));
    if (!file) return exit_status::wrong_script;
    const Script& script = file->script;
    console.tell(script);
    if (!script.program) return exit_status::wrong_script;

    SweepRequest request = options.sweep;
    if (!options.sweep_sets.empty()) {
        auto sets = read_parameter_sets(options.sweep_sets);
        if (!sets) {
            console.fail(sets.error());
            return exit_status::wrong_script;
        }
        request.sets = *std::move(sets);
    }
    auto varied = variations(options, *file);
    if (!varied) {
        console.fail(varied.error());
        return exit_status::wrong_use;
    }
    request.varied = std::move(*varied);
    if (request.sets) request.varied.insert(request.varied.begin(), request.sets->variation);
    request.simulation = options.run.simulation;
    request.pace = options.run.film;
    request.fields = request.fields || !request.data.empty();
    request.log = options.run.log;
    request.moments = options.run.moments;
    if (!file->picture_options.empty()) {
        if (auto stored = picture_request_from_json(file->picture_options)) {
            request.picture = std::move(*stored);
        }
    }
    request.picture = apply(options.picture, std::move(request.picture));
    request.picture.scale = 1;
    request.picture.detail = 1;
    request.picture.space_time = false;

    if (ranks != nullptr) {
        if (auto shared = share_runs(script, *ranks, request); !shared) {
            console.fail(shared.error());
            return exit_status::failed_run;
        }
    }
    const bool is_first = ranks == nullptr || ranks->is_root();

    SweepControl control;
    ProgressDisplay display = make_progress_display(console, options.quiet || !is_first);
    control.report = [&](const SweepProgress& progress) { display.show(progress); };
    std::atomic<bool> hurry = false;
    const std::atomic<bool> may_end = true;  // The results of each complete run have been written.
    const LastMoments last(options.limit_seconds, hurry, may_end);
    std::atomic<bool> ignored = false;  // Rank 0 ends the runs of all ranks.
    const InterruptGuard interrupt(is_first ? control.cancel : ignored);
    const TimeLimit limit(is_first ? options.limit_seconds : 0, control.cancel);
    const auto report = sweep(script, request, control);
    display.clear();
    if (report) {
        return tell(*report, options, std::max(interrupt.signal(), 2), limit.reached(), console);
    }
    if (const auto& wrong = report.error().script) {
        console.tell(*wrong);
        return exit_status::wrong_script;
    }
    console.fail(report.error().failure);
    return report.error().is_in_sets ? exit_status::wrong_script : exit_status::failed_run;
}

}  // namespace

int sweep_command(const Options& options, Console& console) {
    if (launched_ranks()) return run_as_rank(options, console, sweep_script);
    if (options.ranks > 0) return start_ranks(options, console);
    return sweep_script(options, console, nullptr);
}

}  // namespace cascade
