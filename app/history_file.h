// A file of the lines typed at the prompt, for later sessions.
//
// Each line is appended when it is typed, so that none is lost if the terminal is closed or the
// program is killed, and concurrent sessions keep the lines of both. The format is libedit's: a
// first line that identifies it, and in the others all but visible ASCII characters written as a
// backslash and three octal digits.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

class HistoryFile {
public:
    /// The file keeps at most this number of lines.
    static constexpr std::size_t most_lines = 2000;

    /// With an empty path, or in a folder of another user, nothing is stored and load() finds
    /// nothing.
    explicit HistoryFile(std::filesystem::path path);

    /// The last `most_lines` different lines, oldest first. Shortens a file of twice that number.
    std::vector<std::string> load();
    /// Appends a line; creates the folder. Errors are ignored.
    void add(std::string_view line);

private:
    std::filesystem::path path_;
    bool ends_within_line_ = false;
};

}  // namespace cascade
