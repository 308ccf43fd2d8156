// The lines that were typed at the prompt, kept in a file for the next time.
//
// Each line is added to the file when it has been typed, so that none is lost to a terminal that is
// closed or to a program that is killed, and prompts at the same time keep the lines of both. The
// file is one of libedit's: its first line says so, and in the others all but visible ASCII
// characters are written as a backslash and three octal digits.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

class HistoryFile {
public:
    /// At most so many lines are kept.
    static constexpr std::size_t most_lines = 2000;

    /// An empty path: nothing is kept or found; nor in a folder of another user.
    explicit HistoryFile(std::filesystem::path path);

    /// The last lines, oldest first, each once. A file that has grown to twice the most lines is
    /// made shorter.
    std::vector<std::string> load();
    /// Adds a line, if it can; the folder is made where it is missing.
    void add(std::string_view line);

private:
    std::filesystem::path path_;
    bool ends_within_line_ = false;
};

}  // namespace cascade
