// Recognises the messages of mpiexec of Open MPI 4, and of Hydra, the mpiexec of MPICH 4.
#include "app/mpiexec_output.h"

#include "ranks/launcher.h"

#include <fmt/format.h>

#include <regex>
#include <utility>
#include <unistd.h>

namespace cascade {
namespace {

bool is_line_of(std::string_view line, char sign) {
    return line.size() > 40 && line.find_first_not_of(sign) == std::string_view::npos;
}

/// Returns "rank 1 on here was killed by signal 9" for the text "mpiexec noticed that process rank
/// 1 with PID 4711 on node here exited on signal 9 (Killed).", and an empty string for other texts.
std::string killed_by(const std::string& text) {
    static const std::regex words(
        R"(process rank (\d+) with PID \d+ on node (\S+)\s+exited on\s+signal (\d+))");
    std::smatch found;
    if (!std::regex_search(text, found, words)) return "";
    return fmt::format("rank {} on {} was killed by signal {}", found[1].str(), found[2].str(),
                       found[3].str());
}

/// Whether a line belongs to a log: to Open MPI's, "[machine:4711] …", or to MPICH's, "Abort(3) on
/// node 1 …".
bool is_logged(std::string_view line) {
    static const std::regex words(R"(^(\[\S+:\d+\] |Abort\(\d+\) on node ).*)");
    return std::regex_match(line.begin(), line.end(), words);
}

constexpr std::string_view before_rank = "cascade: rank ";

/// Returns the rank and the process that an announcement names. Returns an empty optional if the
/// line is no announcement, or if the process is not on this machine.
std::optional<std::pair<int, pid_t>> announced(const std::string& line) {
    static const std::regex words(R"(^cascade: rank (\d{1,6}) is process (\d{1,9}) on (\S+)$)");
    std::smatch found;
    if (!std::regex_match(line, found, words)) return std::nullopt;
    const auto process = static_cast<pid_t>(std::stol(found[2].str()));
    if (process <= 1 || found[3].str() != this_machine()) return std::nullopt;
    return std::pair(std::stoi(found[1].str()), process);
}

bool is_announcement(std::string_view line) {
    return line.starts_with(before_rank) && line.find(" is process ") != std::string_view::npos;
}

}  // namespace

std::string announcement_of_rank(int rank) {
    return fmt::format("{}{} is process {} on {}", before_rank, rank, ::getpid(), this_machine());
}

/// Adds a line to the explanations. Returns false, because the line is no message of a rank.
bool MpiexecOutput::keep(std::string_view line) {
    explanations_ += std::string(line) + "\n";
    return false;
}

/// Reads a line of MPICH's explanation. An explanation consists of a line of equals signs, lines
/// that begin with an equals sign, another line of equals signs, and three lines about the cause.
bool MpiexecOutput::read_mpich(std::string_view line) {
    static const std::regex process(R"(^=\s+PID (\d{1,9}) RUNNING AT (\S+))");
    static const std::regex signal(R"(\(signal (\d{1,3})\))");
    if (is_line_of(line, '=')) {
        causes_ = frame_ == '=' ? 3 : 0;
        frame_ = frame_ == '=' ? '\0' : '=';
        return keep(line);
    }
    if (frame_ == 0) --causes_;
    const std::string text(line);
    std::smatch found;
    if (std::regex_search(text, found, process)) {
        ended_.process = static_cast<pid_t>(std::stol(found[1].str()));
        ended_.machine = found[2].str();
    }
    if (std::regex_search(text, found, signal)) ended_.signal = std::stoi(found[1].str());
    return keep(line);
}

bool MpiexecOutput::takes(std::string_view line) {
    const bool is_begin = frame_ == 0 && is_line_of(line, '=');
    if (is_begin || frame_ == '=' || causes_ > 0) return read_mpich(line);
    if (is_line_of(line, '-')) {
        if (frame_ == '-' && killed_.empty()) killed_ = killed_by(paragraph_);
        frame_ = frame_ == '-' ? '\0' : '-';
        paragraph_.clear();
        return false;
    }
    if (frame_ == '-') {
        paragraph_ += std::string(line) + " ";
        return keep(line);
    }
    if (is_announcement(line)) {
        if (const auto found = announced(std::string(line))) processes_.insert(*found);
        return false;
    }
    if (is_logged(line)) return keep(line);
    has_error_ = has_error_ || line.find("error:") != std::string_view::npos;
    return true;
}

std::string MpiexecOutput::killed(const MpiexecOutput& ranks) const {
    if (!killed_.empty() || ended_.signal == 0) return killed_;
    std::string who = "a rank";
    for (const auto& [rank, process] : ranks.processes_) {
        if (process == ended_.process) who = fmt::format("rank {}", rank);
    }
    return fmt::format("{} on {} was killed by signal {}", who, ended_.machine, ended_.signal);
}

}  // namespace cascade
