// Appends lines with O_APPEND. If several lines are equal, only the last of them is read. A file
// that is too long is shortened.
#include "app/history_file.h"

#include "core/descriptor.h"
#include "core/file.h"
#include "core/own_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace cascade {

namespace {

constexpr std::string_view first_line = "_HiStOrY_V2_\n";
constexpr std::uint64_t largest = std::uint64_t{64} << 20;

std::string encoded(std::string_view line) {
    std::string text;
    for (const char letter : line) {
        const auto byte = static_cast<unsigned char>(letter);
        if (byte > ' ' && byte < 0x7f && byte != '\\') text += letter;
        else text += fmt::format("\\{:03o}", byte);
    }
    return text + "\n";
}

bool is_octal(std::string_view text) {
    return text.size() == 3 && text.find_first_not_of("01234567") == std::string_view::npos &&
           text[0] < '4';
}

/// Decodes libedit's escapes. Also accepts an escaped backslash and unescaped letters, which some
/// versions of libedit write.
std::string decoded(std::string_view text) {
    std::string line;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text[at] == '\\' && is_octal(text.substr(at + 1, 3))) {
            line += static_cast<char>((text[at + 1] - '0') * 64 + (text[at + 2] - '0') * 8 +
                                      (text[at + 3] - '0'));
            at += 3;
        } else {
            if (text[at] == '\\' && at + 1 < text.size()) ++at;
            line += text[at];
        }
    }
    return line;
}

}  // namespace

HistoryFile::HistoryFile(std::filesystem::path path) : path_(std::move(path)) {
    if (!path_.empty() && !may_keep_files_in(path_)) path_.clear();
}

std::vector<std::string> HistoryFile::load() {
    if (path_.empty()) return {};
    const auto text = read_file(path_, largest);
    if (!text) return {};
    ends_within_line_ = !text->empty() && !text->ends_with('\n');
    std::vector<std::string> lines;
    std::size_t count = 0;
    for (std::size_t begin = 0; begin < text->size(); ++count) {
        const std::size_t end = std::min(text->find('\n', begin), text->size());
        std::string line = decoded(std::string_view(*text).substr(begin, end - begin));
        begin = end + 1;
        const bool is_text = line.find_first_not_of(" \t") != std::string::npos;
        if (is_text && line + "\n" != first_line) lines.push_back(std::move(line));
    }
    // If several lines are equal, only the last of them is read.
    std::set<std::string> known;
    std::vector<std::string> last;
    for (auto line = lines.rbegin(); line != lines.rend() && last.size() < most_lines; ++line) {
        if (known.insert(*line).second) last.push_back(std::move(*line));
    }
    std::reverse(last.begin(), last.end());
    if (count > 2 * most_lines) {
        std::string shorter(first_line);
        for (const std::string& line : last) shorter += encoded(line);
        if (write_file(path_, shorter)) ends_within_line_ = false;
    }
    return last;
}

void HistoryFile::add(std::string_view line) {
    if (path_.empty() || !make_folder(path_.parent_path())) return;
    const Descriptor file(
        ::open(path_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_NONBLOCK | O_CLOEXEC, 0600));
    struct stat status {};
    if (!file.is_open() || ::fstat(file.number(), &status) != 0 || !S_ISREG(status.st_mode)) return;
    std::string text;
    if (status.st_size == 0) text += first_line;
    else if (ends_within_line_) text += "\n";
    text += encoded(line);
    if (write_all(file, text) == 0) ends_within_line_ = false;
}

}  // namespace cascade
