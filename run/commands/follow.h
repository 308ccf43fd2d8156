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
    std::optional<VariedRange> varied;  ///< The parameter to vary, with its range. Must be given.
    /// Whether to begin at a flat state. If not, the end of the run is the beginning.
    bool from_flat = false;
    /// The longest step along a branch, as a fraction of the range and of usual values.
    double step = 0.05;
    /// The largest number of points on each side of a branch's first point.
    std::size_t points = 400;
    std::size_t branches = 1;  ///< The largest number of branches.
    std::size_t pictures = 6;  ///< The largest number of pictures of states below the diagram.
    std::string up;  ///< The number on the vertical axis. Empty: the norm of the first species.
    /// The files to write: tables (.csv) and diagrams. If empty, SCRIPT_branches.csv and
    /// SCRIPT_branches.svg.
    std::vector<std::filesystem::path> outputs;
    /// The folder in which states are saved as runs. Empty: no states are saved.
    std::filesystem::path save;
    SimulationOptions simulation;
};

/// Whether branches can be written to a file with this ending.
bool is_branches_output(const std::filesystem::path& path);

struct FollowReport {
    std::string text;  ///< Describes each branch and each special point in a line.
    std::string json;  ///< All points of the branches, as a JSON array.
    std::vector<std::filesystem::path> written;
};

/// Runs the stages up to the requested one, finds a steady state near the end of the run, and
/// follows it. Fails before the run if the stage cannot have steady states, or has parts that are
/// not supported. After a cancel, the states found so far are written. The script must have double
/// precision.
Result<FollowReport> follow_branches(Script& script, const FollowRequest& request,
                                     RunControl& control);

}  // namespace cascade
