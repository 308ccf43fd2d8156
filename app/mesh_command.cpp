// `cascade mesh`: describes 3-D models.
#include "app/commands.h"
#include "app/exit_status.h"
#include "app/interrupt.h"
#include "run/domain/describe_model.h"

#include <atomic>
#include <optional>

namespace cascade {

int mesh_command(const Options& options, Console& console) {
    std::optional<CellOptions> cells = options.cells;
    if (options.cell_seed) {
        if (!cells || cells->kind != CellKind::places) {
            console.fail({"--seed means nothing without a number of --cells", ""});
            return exit_status::wrong_use;
        }
        cells->seed = *options.cell_seed;
    }
    std::atomic<bool> cancel = false;
    const InterruptGuard interrupt(cancel);
    Team team(hardware_threads());
    int status = exit_status::success;
    for (const std::string& model : options.models) {
        const auto lines = describe_model(model, options.overrides.reads, cells, team, cancel);
        if (cancel) return exit_status::signal_base + interrupt.signal();
        if (!lines) {
            console.fail(lines.error());
            status = exit_status::failed_run;
            continue;
        }
        console.print(model + "\n");
        for (const std::string& line : *lines) console.print("  " + line + "\n");
    }
    return status;
}

}  // namespace cascade
