// Input lines: with editing, history and completion at a terminal, plain from a pipe.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace cascade {

struct TypedLine {
    enum class Kind {
        line,
        cancelled,  ///< Ctrl-C: drops the unfinished input.
        end,        ///< Ctrl-D, or the end of the pipe.
    };
    Kind kind = Kind::end;
    std::string text;  ///< Without its newline.
};

class LineReader {
public:
    virtual ~LineReader() = default;
    virtual TypedLine read(const std::string& prompt) = 0;
};

/// All names that may start the word at the end of `line`; called at each completion.
using NamesToComplete = std::function<std::vector<std::string>(const std::string& line)>;

/// Reads with libedit from standard input. The history is loaded from `history`, and each line is
/// appended to it; an empty path keeps none.
std::unique_ptr<LineReader> make_edit_reader(const std::filesystem::path& history,
                                             NamesToComplete names);

/// Reads from a file descriptor, without prompts.
std::unique_ptr<LineReader> make_plain_reader(int descriptor);

/// $XDG_STATE_HOME/cascade/history, or ~/.local/state/cascade/history; empty without a home folder.
std::filesystem::path history_path();

}  // namespace cascade
