// Groups of options that commands have in common (internal to the reading of options: this header
// includes CLI11, whose headers take seconds to compile).
#pragma once

#include "app/options.h"

#include <CLI/CLI.hpp>

#include <string>

namespace cascade::option_groups {

void add_script(CLI::App& app, Options& options, const std::string& help);
void add_overrides(CLI::App& app, Overrides& overrides);
void add_picture_options(CLI::App& app, PictureChanges& picture);
/// Those of them that a sweep has, too.
void add_shown(CLI::App& app, PictureChanges& picture);
void add_files(CLI::App& app, RunRequest& run);
void add_log(CLI::App& app, RunRequest& run);
/// What every command has that takes steps: backend, threads (`threads` says what they do), lanes.
void add_simulation(CLI::App& app, Options& options, const std::string& threads);
/// Models, and the cells to spread over them.
void add_mesh(CLI::App& app, Options& options);
/// Where a run stops: --stop-at.
void add_stop(CLI::App& app, Options& options);
void add_timing(CLI::App& app, Options& options);
void add_limits(CLI::App& app, Options& options);
void add_quiet(CLI::App& app, Options& options);
void add_dump(CLI::App& app, Options& options);
void add_bench(CLI::App& app, Options& options);
void add_compile(CLI::App& app, Options& options);
void add_sweep(CLI::App& app, Options& options);

}  // namespace cascade::option_groups
