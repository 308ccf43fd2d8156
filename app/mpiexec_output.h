// Reads what mpiexec and the ranks write to standard error.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <sys/types.h>

namespace cascade {

/// A line that rank 0 prints when it starts. It tells the process that has called mpiexec which
/// process must receive Ctrl-C.
std::string announcement_of_root();

/// Separates the messages of ranks, which are passed on, from the explanations of mpiexec, which
/// Open MPI puts between lines of dashes.
class MpiexecOutput {
public:
    /// Takes the next line, without its end. Returns whether it is a message that a rank has
    /// written for the user.
    bool takes(std::string_view line);

    /// The process of rank 0. Empty if it is unknown or runs on another machine.
    std::optional<pid_t> root() const { return root_; }

    /// The last signal that has killed a rank, as Open MPI or MPICH explains it; empty if there was
    /// none: "rank 1 on MACHINE was killed by signal 9".
    const std::string& killed() const { return killed_; }
    /// The explanations of mpiexec.
    const std::string& explanations() const { return explanations_; }
    /// Whether a rank has reported an error.
    bool has_error() const { return has_error_; }

private:
    bool is_explained_ = false;  ///< Whether the next line is between lines of dashes.
    bool has_error_ = false;
    std::string explanations_, killed_, paragraph_;
    std::optional<pid_t> root_;
};

}  // namespace cascade
