// A file with the lines typed at the prompt, for later sessions.
//
// Each line is appended when it is typed, so that no line is lost if the terminal is closed or the
// program is killed. Sessions that run at the same time all add their lines. The file has the
// format of the library libedit. The first line identifies the format. In all other lines, every
// character except visible ASCII characters is written as a backslash and three octal digits.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

class HistoryFile {
public:
    /// The largest number of lines that load() returns. If the file has at least twice as many
    /// lines, load() shortens it to this number.
    static constexpr std::size_t most_lines = 2000;

    /// If the path is empty or its folder belongs to another user, no line is stored, and load()
    /// returns no lines.
    explicit HistoryFile(std::filesystem::path path);

    /// Returns the last `most_lines` different lines, the oldest first. Shortens the file to these
    /// lines if it has at least twice as many.
    std::vector<std::string> load();
    /// Appends a line. Creates the folder if necessary. Errors are ignored.
    void add(std::string_view line);

private:
    std::filesystem::path path_;
    bool ends_within_line_ = false;
};

}  // namespace cascade
