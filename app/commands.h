// The commands of the program: each takes options and returns an exit status.
#pragma once

#include "app/console.h"
#include "app/options.h"
#include "app/progress_display.h"
#include "run/session/session_log.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace cascade {

int run_command(const Options& options, Console& console);
int sweep_command(const Options& options, Console& console);
int check_command(const Options& options, Console& console);
int analyze_command(const Options& options, Console& console);
int bench_command(const Options& options, Console& console);
int compile_command(const Options& options, Console& console);
int systems_command(const Options& options, Console& console);
int new_command(const Options& options, Console& console);
int palettes_command(const Options& options, Console& console);
int format_command(const Options& options, Console& console);
int mesh_command(const Options& options, Console& console);
int view_command(const Options& options, Console& console);
int export_command(const Options& options, Console& console);
int repl_command(const Options& options, Console& console);

/// What a command is at the prompt: there ':check' is 'cascade check' of the script so far.
enum class AtPrompt { absent, plain, of_script };

struct CommandEntry {
    Command command;
    std::string_view name;
    int (*action)(const Options& options, Console& console);
    AtPrompt at_prompt;
    /// One sentence, and the end of the command's help.
    std::string_view about, examples;
    void (*add_options)(CLI::App& command, Options& options);
};

/// All commands of the program.
std::span<const CommandEntry> command_table();

/// Prints the measures; one that does not exist (a uniform field has no wavelength) is a dash.
void print_features(const measure::Features& features, Console& console);

/// A bar in a terminal, lines in a pipe, nothing if `quiet`.
ProgressDisplay make_progress_display(const Console& console, bool quiet);

/// Loads a script or a picture; "-" is the script that was typed at the prompt, else standard
/// input. Prints an error if it cannot be read.
std::optional<LoadedFile> load(const std::string& path, const Overrides& overrides,
                               const Console& console, const TypedScript* typed = nullptr);

/// The session of a picture, if `changes` do not ask for another run than it had; tells which it
/// is, unless `quiet`.
Result<std::optional<SessionLog>> session_to_play(const LoadedFile& file, Overrides changes,
                                                  const Console& console, bool quiet);

/// All of standard input, as the text of a script. Fails beyond `largest_script` bytes.
Result<std::string> read_standard_input();

/// Prints what `--dump` asks for, also for a script with errors. Returns the exit status.
int dump_command(const Script& script, const std::string& kind, Console& console);

}  // namespace cascade
