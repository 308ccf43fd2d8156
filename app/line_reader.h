// Reads input lines. In a terminal, they can be edited and completed, and earlier lines can be
// recalled.
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
        cancelled,  ///< The user has pressed Ctrl-C, which discards the unfinished input.
        end,        ///< The user has pressed Ctrl-D, or the pipe has ended.
    };
    Kind kind = Kind::end;
    std::string text;  ///< The line without its newline.
};

class LineReader {
public:
    virtual ~LineReader() = default;
    virtual TypedLine read(const std::string& prompt) = 0;
};

/// Returns the names that may complete the word at the end of `line`. Called whenever the user asks
/// for a completion.
using NamesToComplete = std::function<std::vector<std::string>(const std::string& line)>;

/// Makes a reader of standard input with libedit. The history is loaded from the file `history`,
/// and each line is appended to that file. With an empty path there is no history.
std::unique_ptr<LineReader> make_edit_reader(const std::filesystem::path& history,
                                             NamesToComplete names);

/// Makes a reader of a file descriptor. The reader shows no prompts.
std::unique_ptr<LineReader> make_plain_reader(int descriptor);

/// Returns $XDG_STATE_HOME/cascade/history or ~/.local/state/cascade/history. Returns an empty path
/// if the user has no home folder.
std::filesystem::path history_path();

}  // namespace cascade
