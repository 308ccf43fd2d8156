// The commands of the program, from options to an exit status.
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

/// A bar in a terminal, lines in a pipe, nothing where the user wants quiet.
ProgressDisplay make_progress_display(const Console& console, bool quiet);

/// A script or a picture; "-" is standard input. Says why where there is nothing to read.
std::optional<LoadedFile> load(const std::string& path, const Overrides& overrides,
                               const Console& console);

/// All of standard input, as the text of a script.
Result<std::string> read_standard_input();

/// What `--dump` asks for, of a script that may be wrong. Exit status.
int dump_command(const Script& script, const std::string& kind, Console& console);

}  // namespace cascade
