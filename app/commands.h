// The commands of the program. Each command receives options and returns an exit status.
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
int continue_command(const Options& options, Console& console);
int check_command(const Options& options, Console& console);
int analyze_command(const Options& options, Console& console);
int bench_command(const Options& options, Console& console);
int compile_command(const Options& options, Console& console);
int systems_command(const Options& options, Console& console);
int new_command(const Options& options, Console& console);
int examples_command(const Options& options, Console& console);
int palettes_command(const Options& options, Console& console);
int import_command(const Options& options, Console& console);
int format_command(const Options& options, Console& console);
int mesh_command(const Options& options, Console& console);
int view_command(const Options& options, Console& console);
int export_command(const Options& options, Console& console);
int lsp_command(const Options& options, Console& console);
int repl_command(const Options& options, Console& console);

/// Whether and how a command can be used at the prompt. A command with `of_script` works on the
/// script typed so far: ':check' checks it as 'cascade check' checks a file.
enum class AtPrompt { absent, plain, of_script };

struct CommandEntry {
    Command command;
    std::string_view name;
    int (*action)(const Options& options, Console& console);
    AtPrompt at_prompt;
    /// A sentence about the command, and the examples at the end of its help.
    std::string_view about, examples;
    void (*add_options)(CLI::App& command, Options& options);
};

/// Returns all commands of the program.
std::span<const CommandEntry> command_table();

/// Prints features. If a feature does not exist, such as the wavelength of a uniform field, prints
/// a dash.
void print_features(const measure::Features& features, Console& console);

/// Prints a line of a list. In a terminal, cuts it at the terminal's width.
void print_list_line(std::string_view name, std::string_view about, Console& console);

/// Makes a display of progress. It draws a bar in a terminal, prints lines to a pipe, and shows
/// nothing if `quiet` is true.
ProgressDisplay make_progress_display(const Console& console, bool quiet);

/// Loads a script or a picture. The path "-" means the script typed at the prompt or, if `typed` is
/// null, standard input. Prints an error if the file cannot be read.
std::optional<LoadedFile> load(const std::string& path, const Overrides& overrides,
                               const Console& console, const TypedScript* typed = nullptr);

/// Returns the session that the picture `file` contains, and prints a note about it unless `quiet`
/// is true. Returns an empty optional if the picture contains no session, or if `changes` make the
/// run differ from the session.
Result<std::optional<SessionLog>> session_to_play(const LoadedFile& file, Overrides changes,
                                                  const Console& console, bool quiet);

/// Reads standard input as the text of a script. Fails if it has more than `largest_script` bytes.
Result<std::string> read_standard_input();

/// Prints the intermediate form of the script that the option `--dump` requests. Some kinds also
/// work for a script with errors. Returns the exit status.
int dump_command(const Script& script, const std::string& kind, Console& console);

}  // namespace cascade
