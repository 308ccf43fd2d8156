// Groups of options that several commands have. Only files that define options may include this
// header, because it includes CLI11, whose headers take seconds to compile.
#pragma once

#include "app/options.h"
#include "run/commands/run_option.h"

#include <CLI/CLI.hpp>

#include <string>

namespace cascade::option_groups {

inline constexpr const char* execution_group =
    "How to compute (the results are the same, bit for bit)";

void add_script(CLI::App& app, Options& options, const std::string& help);
void add_allow_read(CLI::App& app, ReadAccess& reads, const std::string& about);
void add_overrides(CLI::App& app, Overrides& overrides);
/// Adds the picture options of `cascade run`. If `is_sweep` is true, adds only the picture options
/// that `cascade sweep` has, too.
void add_picture_options(CLI::App& app, PictureChanges& picture, bool is_sweep = false);
void add_files(CLI::App& app, RunRequest& run);
/// Adds the options of run_options.def from `first` to `last`, including both.
void add_run_options(CLI::App& app, RunRequest& run, RunOption first, RunOption last);
/// Adds the options of all commands that take steps: backend, threads and lanes. `threads` is the
/// help text of the option --threads.
void add_simulation(CLI::App& app, Options& options, const std::string& threads);
/// Adds the arguments and options of `cascade mesh`, for models and for the cells on models.
void add_mesh(CLI::App& app, Options& options);
void add_timing(CLI::App& app, Options& options);
/// `work` names the work that the ranks share: "steps" or "runs".
void add_ranks(CLI::App& app, Options& options, std::string_view work);
void add_device(CLI::App& app, Options& options);
void add_limits(CLI::App& app, Options& options);
void add_quiet(CLI::App& app, Options& options);
void add_dump(CLI::App& app, Options& options);
void add_json(CLI::App& app, Options& options);
void add_analyze(CLI::App& app, Options& options);
void add_bench(CLI::App& app, Options& options);
void add_compile(CLI::App& app, Options& options);
void add_export(CLI::App& app, Options& options);
void add_sweep(CLI::App& app, Options& options);
void add_seeds(CLI::App& app, Options& options, const std::string& group, const std::string& help);
void add_follow(CLI::App& app, Options& options);

}  // namespace cascade::option_groups
