// Exit statuses of the program.
#pragma once

namespace cascade::exit_status {

constexpr int success = 0;
constexpr int would_change = 1;  ///< `fmt --check` found a script that is not in the standard form.
/// `repl` read from a pipe, and a line had an error or a run failed.
constexpr int wrong_line = 1;
/// `lsp`: the editor has ended without the request `shutdown`.
constexpr int no_shutdown = 1;
constexpr int wrong_script = 2;  ///< The script has errors or cannot be read.
constexpr int failed_run = 3;    ///< A run failed, or an output could not be written.
constexpr int wrong_use = 64;    ///< Wrong options or arguments. EX_USAGE of BSD's sysexits.h.
/// The run was stopped by --limit-time. timeout(1) returns the same number.
constexpr int time_limit = 124;
constexpr int bug = 70;  ///< A mistake in Cascade itself. EX_SOFTWARE of BSD's sysexits.h.
/// The program was stopped by signal n. The status is 128 + n, such as 130 for Ctrl-C.
constexpr int signal_base = 128;

}  // namespace cascade::exit_status
