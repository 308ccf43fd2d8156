// Defines the arguments and options of each command.
#pragma once

#include "app/options.h"

namespace CLI {
class App;
}

namespace cascade::command_options {

void run(CLI::App& command, Options& options);
void sweep(CLI::App& command, Options& options);
void follow(CLI::App& command, Options& options);
void check(CLI::App& command, Options& options);
void analyze(CLI::App& command, Options& options);
void bench(CLI::App& command, Options& options);
void compile(CLI::App& command, Options& options);
void systems(CLI::App& command, Options& options);
void examples(CLI::App& command, Options& options);
void new_script(CLI::App& command, Options& options);
void import_model(CLI::App& command, Options& options);
void palettes(CLI::App& command, Options& options);
void format(CLI::App& command, Options& options);
void mesh(CLI::App& command, Options& options);
void repl(CLI::App& command, Options& options);
void export_page(CLI::App& command, Options& options);
void view(CLI::App& command, Options& options);
void lsp(CLI::App& command, Options& options);

}  // namespace cascade::command_options
