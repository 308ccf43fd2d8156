// Reads the messages that mpiexec and the ranks print.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <sys/types.h>

namespace cascade {

/// Returns a line that a rank prints when it starts. From this line, the process that has called
/// mpiexec learns the rank of each process, and which process must receive Ctrl-C.
std::string announcement_of_rank(int rank);

/// Separates the output of ranks, which is passed on, from the explanations of mpiexec. Open MPI
/// puts them between lines of dashes on standard error, and MPICH between lines of equals signs on
/// standard output, so there is one object for each stream.
class MpiexecOutput {
public:
    /// Takes the next line, without its end. Returns whether the line is a message that a rank has
    /// written for the user.
    bool takes(std::string_view line);

    /// Returns the process of rank 0. Returns an empty optional if the process is unknown or runs
    /// on another machine.
    std::optional<pid_t> root() const {
        const auto found = processes_.find(0);
        return found != processes_.end() ? std::optional(found->second) : std::nullopt;
    }

    /// Says which rank a signal has killed, according to Open MPI or MPICH: "rank 1 on MACHINE was
    /// killed by signal 9". Returns an empty string if no rank was killed. `ranks` must have read
    /// the announcements of the ranks.
    std::string killed(const MpiexecOutput& ranks) const;
    /// The explanations of mpiexec.
    const std::string& explanations() const { return explanations_; }
    /// Whether a rank has reported an error.
    bool has_error() const { return has_error_; }

private:
    /// A process that has ended, according to MPICH.
    struct Ended {
        pid_t process = 0;
        std::string machine;
        int signal = 0;
    };

    bool keep(std::string_view line);
    bool read_mpich(std::string_view line);

    /// The sign of the lines around the explanation that is being read: '-' for Open MPI, '=' for
    /// MPICH, and 0 outside of explanations.
    char frame_ = 0;
    int causes_ = 0;  ///< The number of lines about the cause that are still to come from MPICH.
    bool has_error_ = false;
    std::string explanations_, killed_, paragraph_;
    Ended ended_;
    std::map<int, pid_t> processes_;  ///< The processes of ranks on this machine, by rank.
};

}  // namespace cascade
