// The command `cascade continue` follows steady states, shows progress, and reports the branches.
#include "app/commands.h"
#include "app/exit_status.h"
#include "app/interrupt.h"
#include "app/json_answer.h"
#include "app/last_moments.h"
#include "app/limits.h"
#include "app/option_values.h"
#include "app/progress_display.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>

namespace cascade {

namespace {

/// Adds the members of --json that describe the branches.
void answer(const FollowReport& report, const std::string& varied, JsonAnswer& all) {
    using Json = nlohmann::ordered_json;
    all["varied"] = varied;
    all["branches"] = Json::parse(report.json);
    all["written"] = Json::array();
    for (const auto& path : report.written) all["written"].push_back(path.string());
}

}  // namespace

int continue_command(const Options& options, Console& console) {
    Overrides overrides = options.overrides;
    overrides.precision = Precision::binary64;
    auto file = load(options.scripts[0], overrides, console, typed_of(options));
    if (!file) return exit_status::wrong_script;
    Script& script = file->script;
    console.tell(script);
    if (!script.program) return exit_status::wrong_script;

    FollowRequest request = options.follow;
    if (!request.varied) {
        console.fail({"nothing is varied", "add --vary, as in --vary feed=0.02..0.06"});
        return exit_status::wrong_use;
    }
    request.simulation = options.run.simulation;
    RunControl control;
    ProgressDisplay display = make_progress_display(console, options.quiet);
    control.report = [&](const Progress& progress) { display.show(progress); };
    const LastMoments last(options.limit_seconds, control.hurry, control.may_end);
    const InterruptGuard interrupt(control.cancel);
    const TimeLimit limit(options.limit_seconds, control.cancel);
    request.simulation.control = &control;
    const auto report = follow_branches(script, request, control);
    display.clear();
    const auto status_of_end = [&] {
        return limit.reached() ? exit_status::time_limit
                               : exit_status::signal_base + std::max(interrupt.signal(), 2);
    };
    if (!report && script.diagnostics.has_errors()) {
        console.tell(script);
        return exit_status::wrong_script;
    }
    if (!report) {
        console.fail(report.error());
        return control.cancel ? status_of_end() : exit_status::failed_run;
    }
    console.print(report->text);
    if (JsonAnswer* const all = console.answer()) {
        answer(*report, request.varied->name, *all);
        (*all)["outcome"] = !control.cancel   ? "finished"
                            : limit.reached() ? "time limit"
                                              : "interrupted";
    }
    if (!options.quiet) {
        for (const auto& path : report->written) {
            console.say(fmt::format("wrote {}\n", path.string()));
        }
    }
    if (!control.cancel) return exit_status::success;
    if (limit.reached()) {
        console.say(fmt::format("cascade: the limit of {} is reached\n",
                                describe_duration(options.limit_seconds)));
    }
    return status_of_end();
}

}  // namespace cascade
