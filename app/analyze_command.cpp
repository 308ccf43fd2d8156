// The command `cascade analyze` predicts from its equations what will grow in a run.
#include "app/commands.h"
#include "app/exit_status.h"
#include "run/stage/kernel_cache.h"

#include <fmt/format.h>

namespace cascade {

int analyze_command(const Options& options, Console& console) {
    auto file = load(options.scripts[0], options.overrides, console, typed_of(options));
    if (!file) return exit_status::wrong_script;
    Script& script = file->script;
    console.say(script.messages(console.error().colour));
    if (!script.program) return exit_status::wrong_script;
    AnalyzeRequest request = options.analyze;
    request.kernel_cache = usual_kernel_cache();
    const auto report = analyze(script, request);
    if (!report && script.diagnostics.has_errors()) {
        console.say(script.messages(console.error().colour));
        return exit_status::wrong_script;
    }
    if (!report) {
        console.fail(report.error());
        return exit_status::failed_run;
    }
    console.print(report->text);
    for (const auto& path : report->written) {
        console.say(fmt::format("wrote {}\n", path.string()));
    }
    return exit_status::success;
}

}  // namespace cascade
