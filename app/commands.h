// The commands of the program: each takes options and returns an exit status.
#pragma once

#include "app/console.h"
#include "app/options.h"
#include "app/progress_display.h"

namespace cascade {

int run_command(const Options& options, Console& console);
int sweep_command(const Options& options, Console& console);
int check_command(const Options& options, Console& console);
int bench_command(const Options& options, Console& console);
int compile_command(const Options& options, Console& console);
int systems_command(const Options& options, Console& console);
int new_command(const Options& options, Console& console);
int format_command(const Options& options, Console& console);
int mesh_command(const Options& options, Console& console);
int view_command(const Options& options, Console& console);

/// A bar in a terminal, lines in a pipe, nothing if `quiet`.
ProgressDisplay make_progress_display(const Console& console, bool quiet);

/// Loads a script or a picture; "-" is standard input. Prints an error if it cannot be read.
std::optional<LoadedFile> load(const std::string& path, const Overrides& overrides,
                               const Console& console);

/// All of standard input, as the text of a script. Fails beyond `largest_script` bytes.
Result<std::string> read_standard_input();

/// Prints what `--dump` asks for, also for a script with errors. Returns the exit status.
int dump_command(const Script& script, const std::string& kind, Console& console);

}  // namespace cascade
