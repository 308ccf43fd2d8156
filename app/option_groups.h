// Groups of options that commands share (internal: this header includes CLI11, whose headers take
// seconds to compile).
#pragma once

#include "app/options.h"
#include "run/commands/run_option.h"

#include <CLI/CLI.hpp>

#include <string>

namespace cascade::option_groups {

inline constexpr const char* execution_group =
    "How it is computed (the results are the same, bit for bit)";

void add_script(CLI::App& app, Options& options, const std::string& help);
void add_allow_read(CLI::App& app, ReadAccess& reads, const std::string& about);
void add_overrides(CLI::App& app, Overrides& overrides);
/// Of `cascade run`, or those of them that `cascade sweep` has, too.
void add_picture_options(CLI::App& app, PictureChanges& picture, bool is_sweep = false);
void add_files(CLI::App& app, RunRequest& run);
/// The rows of run_options.def from the first to the last.
void add_run_options(CLI::App& app, RunRequest& run, RunOption first, RunOption last);
/// Options of all commands that take steps: backend, threads (`threads` is their help text), lanes.
void add_simulation(CLI::App& app, Options& options, const std::string& threads);
/// Models, and the cells to make on them.
void add_mesh(CLI::App& app, Options& options);
void add_timing(CLI::App& app, Options& options);
void add_limits(CLI::App& app, Options& options);
void add_quiet(CLI::App& app, Options& options);
void add_dump(CLI::App& app, Options& options);
void add_json(CLI::App& app, Options& options);
void add_analyze(CLI::App& app, Options& options);
void add_bench(CLI::App& app, Options& options);
void add_compile(CLI::App& app, Options& options);
void add_export(CLI::App& app, Options& options);
void add_sweep(CLI::App& app, Options& options);

}  // namespace cascade::option_groups
