// The command `cascade repl` handles lines one after the other. The lines come from a line editor
// at a terminal, or from a pipe.
#include "app/commands.h"
#include "app/exit_status.h"
#include "app/interrupt.h"
#include "app/line_reader.h"
#include "app/prompt_session.h"
#include "app/session_file.h"

#include <filesystem>
#include <unistd.h>

namespace cascade {

int repl_command(const Options& options, Console& console) {
    const bool at_terminal = isatty(STDIN_FILENO) == 1 && console.out().is_terminal;
    PromptSession session(options.run.simulation, console, at_terminal,
                          at_terminal ? ask_terminal(console.out()) : TerminalPictures());
    const auto reader =
        at_terminal ? make_edit_reader(history_path(),
                                       [&](const std::string& line) { return session.names(line); })
                    : make_plain_reader(STDIN_FILENO);
    if (at_terminal) stay_on_interrupt();
    if (at_terminal) console.say("Cascade: ':help' lists the commands, Ctrl-D leaves.\n");
    const std::filesystem::path loaded = options.scripts.empty() ? "" : options.scripts[0];
    if (at_terminal) {
        tell_of_files_left(loaded.parent_path(), loaded.empty() ? "prompt" : loaded.stem().string(),
                           loaded, "repl", console);
    }
    if (!loaded.empty()) session.load(loaded.string());
    // Errors change the status only if lines come from a pipe. At a terminal, the user has seen
    // them.
    const auto status = [&] {
        return !at_terminal && session.has_failed() ? exit_status::wrong_line
                                                    : exit_status::success;
    };
    while (true) {
        session.tell_where_kept();
        const TypedLine line = reader->read(session.prompt());
        if (line.kind == TypedLine::Kind::cancelled) {
            session.drop_pending();
            continue;
        }
        if (line.kind == TypedLine::Kind::end) break;
        if (!session.take(line.text)) return status();
    }
    session.end();
    if (at_terminal) console.say("\n");
    return status();
}

}  // namespace cascade
