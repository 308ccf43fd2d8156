// The command `cascade bench` measures the speed of the steps of scripts.
#include "app/bench_table.h"
#include "app/commands.h"
#include "app/exit_status.h"
#include "app/interrupt.h"
#include "app/limits.h"
#include "app/option_values.h"
#include "core/printable.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade {

namespace {

int bench_one(const std::string& path, const Options& options, RunControl& control,
              Console& console) {
    auto file = load(path, options.overrides, console, typed_of(options));
    if (!file) return exit_status::wrong_script;
    Script& script = file->script;
    console.say(script.messages(console.error().colour));
    if (!script.program) return exit_status::wrong_script;
    script.diagnostics = {};  // The warnings in it have already been printed.

    BenchRequest request = options.bench;
    request.simulation = options.run.simulation;
    request.has_limits = !options.csv;
    const auto done = bench(script, request, control, [&](const StageBench& stage) {
        const std::string name = printable(script.name);
        console.print(options.csv ? bench_csv_row(name, stage) : bench_table(name, stage));
    });
    if (done) return exit_status::success;
    console.say(script.messages(console.error().colour));
    if (script.diagnostics.has_errors()) return exit_status::wrong_script;
    console.fail(done.error());
    return exit_status::failed_run;
}

}  // namespace

int bench_command(const Options& options, Console& console) {
    RunControl control;
    control.warn = [&](const std::string& message) {
        if (!options.quiet) console.warn(message);
    };
    const InterruptGuard interrupt(control.cancel);
    const TimeLimit limit(options.limit_seconds, control.cancel);
    if (options.csv) console.print(bench_csv_header());
    int status = exit_status::success;
    for (const std::string& path : options.scripts) {
        status = std::max(status, bench_one(path, options, control, console));
        if (!control.cancel) continue;
        if (limit.reached()) {
            console.say(fmt::format("cascade: the limit of {} is reached\n",
                                    describe_duration(options.limit_seconds)));
            return exit_status::time_limit;
        }
        console.say("cascade: interrupted\n");
        return exit_status::signal_base + std::max(interrupt.signal(), 2);
    }
    return status;
}

}  // namespace cascade
