// The command `cascade export` writes a script, its files and the engine as one page.
#include "app/commands.h"
#include "app/exit_status.h"
#include "app/interrupt.h"
#include "core/file.h"
#include "core/quantities.h"
#include "run/session/live_run.h"
#include "view/standalone_page.h"

#include <fmt/format.h>

namespace cascade {

int export_command(const Options& options, Console& console) {
    auto file = load(options.scripts[0], options.overrides, console, typed_of(options));
    if (!file) return exit_status::wrong_script;
    console.say(file->script.messages(console.error().colour));
    if (!file->script.program) return exit_status::wrong_script;
    auto path = options.html;
    if (path.empty()) path = output_stem(file->script) + ".html";
    const auto fail = [&](const Failure& failure) {
        console.fail(failure);
        return exit_status::failed_run;
    };
    const auto engine = read_engine();
    if (!engine) return fail(engine.error());
    if (const auto possible = check_writable(path); !possible) return fail(possible.error());

    RunControl control;
    const InterruptGuard interrupt(control.cancel);
    SimulationOptions simulation = options.run.simulation;
    // The interpreter is enough, because only starting values are computed.
    simulation.backend = "interp";
    const auto run = LiveRun::begin(std::move(file->script), simulation, control);
    if (!run) {
        console.say(run.error().messages(console.error().colour));
        return exit_status::failed_run;
    }
    auto carried = carried_by((*run)->script(), (*run)->simulation());
    if (!carried) return fail(carried.error());
    carried->is_exact = options.exact;
    const std::string page = standalone_page(*carried, *engine);
    if (const auto written = write_file(path, page); !written) return fail(written.error());
    console.print(
        fmt::format("{} ({})\n", path.string(), with_unit(static_cast<double>(page.size()), "B")));
    return exit_status::success;
}

}  // namespace cascade
