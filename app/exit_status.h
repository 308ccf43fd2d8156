// Exit statuses of the program.
#pragma once

namespace cascade::exit_status {

constexpr int success = 0;
constexpr int would_change = 1;   ///< `fmt --check`: a script is not in the canonical style.
constexpr int wrong_line = 1;     ///< `repl` from a pipe: a line had an error, or a run failed.
constexpr int wrong_script = 2;   ///< The script has errors, or cannot be read.
constexpr int failed_run = 3;     ///< A run diverged, or an output cannot be written.
constexpr int wrong_use = 64;     ///< EX_USAGE of BSD's sysexits.h: wrong options or arguments.
constexpr int time_limit = 124;   ///< Stopped by --limit-time; the number is timeout(1)'s.
constexpr int bug = 70;           ///< EX_SOFTWARE: an error in Cascade itself.
constexpr int signal_base = 128;  ///< Stopped by signal n: 128 + n, so 130 for Ctrl-C.

}  // namespace cascade::exit_status
