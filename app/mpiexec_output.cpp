// Recognises the messages of Open MPI 4 and of Hydra, the launcher of MPICH 4.
#include "app/mpiexec_output.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <regex>
#include <unistd.h>

namespace cascade {
namespace {

bool is_line_of_dashes(std::string_view line) {
    return line.size() > 40 && line.find_first_not_of('-') == std::string_view::npos;
}

/// "mpiexec noticed that process rank 1 with PID 4711 on node here exited on signal 9 (Killed)."
std::string killed_by(const std::string& text) {
    static const std::regex words(
        R"(process rank (\d+) with PID \d+ on node (\S+)\s+exited on\s+signal (\d+))");
    std::smatch found;
    if (!std::regex_search(text, found, words)) return "";
    return fmt::format("rank {} on {} was killed by signal {}", found[1].str(), found[2].str(),
                       found[3].str());
}

/// Whether this is a line of Open MPI's log: "[machine:4711] …".
bool is_logged(std::string_view line) {
    static const std::regex words(R"(^\[\S+:\d+\] .*)");
    return std::regex_match(line.begin(), line.end(), words);
}

std::string this_machine() {
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "?";
}

constexpr std::string_view before_process = "cascade: rank 0 is process ";

/// The process that an announcement names, if it is on this machine.
std::optional<pid_t> announced(std::string_view line) {
    pid_t process = 0;
    const char* const end = line.data() + line.size();
    const auto read = std::from_chars(line.data() + before_process.size(), end, process);
    const bool is_here = std::string_view(read.ptr, end) == " on " + this_machine();
    return read.ec == std::errc() && process > 1 && is_here ? std::optional(process) : std::nullopt;
}

}  // namespace

std::string announcement_of_root() {
    return fmt::format("{}{} on {}", before_process, ::getpid(), this_machine());
}

bool MpiexecOutput::takes(std::string_view line) {
    if (is_line_of_dashes(line)) {
        if (is_explained_ && killed_.empty()) killed_ = killed_by(paragraph_);
        is_explained_ = !is_explained_;
        paragraph_.clear();
        return false;
    }
    if (is_explained_) {
        paragraph_ += std::string(line) + " ";
        explanations_ += std::string(line) + "\n";
        return false;
    }
    if (line.starts_with(before_process)) {
        root_ = announced(line);
        return false;
    }
    if (is_logged(line)) {
        explanations_ += std::string(line) + "\n";
        return false;
    }
    has_error_ = has_error_ || line.find("error:") != std::string_view::npos;
    return true;
}

}  // namespace cascade
