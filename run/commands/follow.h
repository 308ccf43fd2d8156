// The command `cascade continue` follows the steady states of a stage through a parameter.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "run/commands/variation.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

struct FollowRequest {
    /// The name of a stage, or its number, counted from 1. Empty: the last stage.
    std::string stage;
    std::optional<VariedRange> varied;  ///< Must be given.
    bool from_flat = false;  ///< Whether the first state is flat, and not the end of the run.
    double step = 0.05;      ///< The longest step, as a fraction of the range and of usual values.
    std::size_t points = 400;  ///< The most points on each side of a branch's first point.
    std::size_t branches = 1;  ///< The most branches.
    std::size_t pictures = 6;  ///< The most pictures of states below the diagram.
    std::string up;  ///< The number on the vertical axis. Empty: the norm of the first species.
    /// Tables (.csv) and diagrams. If empty, SCRIPT_branches.csv and SCRIPT_branches.svg.
    std::vector<std::filesystem::path> outputs;
    std::filesystem::path save;  ///< The folder in which states are saved as runs. Empty: none.
    SimulationOptions simulation;
};

/// Whether branches can be written to a file with this ending.
bool is_branches_output(const std::filesystem::path& path);

struct FollowReport {
    std::string text;  ///< A line for each branch and each special point.
    std::string json;  ///< The branches with all points, a JSON array.
    std::vector<std::filesystem::path> written;
};

/// Runs the stages up to the requested one, finds a steady state near the end of the run, and
/// follows it. Fails before the run if the stage cannot have steady states, or has parts that are
/// not supported. After a cancel, the states found so far are written. The script must have double
/// precision.
Result<FollowReport> follow_branches(Script& script, const FollowRequest& request,
                                     RunControl& control);

}  // namespace cascade
