// Groups of options that commands share (internal: this header includes CLI11, whose headers take
// seconds to compile).
#pragma once

#include "app/options.h"

#include <CLI/CLI.hpp>

#include <string>

namespace cascade::option_groups {

void add_script(CLI::App& app, Options& options, const std::string& help);
void add_overrides(CLI::App& app, Overrides& overrides);
void add_picture_options(CLI::App& app, PictureChanges& picture);
/// The options of add_picture() and add_output() that a sweep has, too.
void add_shown(CLI::App& app, PictureChanges& picture);
/// How fast films are.
void add_film_pace(CLI::App& app, FilmRequest& film);
void add_files(CLI::App& app, RunRequest& run);
void add_log(CLI::App& app, RunRequest& run);
/// Options of all commands that take steps: backend, threads (`threads` is their help text), lanes.
void add_simulation(CLI::App& app, Options& options, const std::string& threads);
/// Models, and the cells to make on them.
void add_mesh(CLI::App& app, Options& options);
/// --stop-at.
void add_stop(CLI::App& app, Options& options);
void add_timing(CLI::App& app, Options& options);
void add_limits(CLI::App& app, Options& options);
void add_quiet(CLI::App& app, Options& options);
void add_dump(CLI::App& app, Options& options);
void add_analyze(CLI::App& app, Options& options);
void add_bench(CLI::App& app, Options& options);
void add_compile(CLI::App& app, Options& options);
void add_export(CLI::App& app, Options& options);
void add_sweep(CLI::App& app, Options& options);

}  // namespace cascade::option_groups
