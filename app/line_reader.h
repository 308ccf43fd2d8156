// Lines that a user types: with editing, history and completion at a terminal, as they come from a
// pipe.
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
        cancelled,  ///< Ctrl-C: what has been begun is dropped.
        end,        ///< Ctrl-D, or the end of the pipe.
    };
    Kind kind = Kind::end;
    std::string text;  ///< Without its line end.
};

class LineReader {
public:
    virtual ~LineReader() = default;
    virtual TypedLine read(const std::string& prompt) = 0;
};

/// Every name that may stand where a word begins; asked anew at each completion.
using NamesToComplete = std::function<std::vector<std::string>(const std::string& line)>;

/// By libedit, on standard input and output. The history is read from `history`, and each line is
/// added to it as it is typed (nowhere if that is empty or cannot be written).
std::unique_ptr<LineReader> make_edit_reader(const std::filesystem::path& history,
                                             NamesToComplete names);

/// From a file descriptor, without prompts.
std::unique_ptr<LineReader> make_plain_reader(int descriptor);

/// $XDG_STATE_HOME/cascade/history, or ~/.local/state/cascade/history; empty without a home.
std::filesystem::path history_path();

}  // namespace cascade
