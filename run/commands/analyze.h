// The command `cascade analyze` predicts from the equations alone which patterns will grow. The
// command takes no steps, except in the trial run of a stage with a size.
#pragma once

#include "core/result.h"
#include "run/commands/variation.h"
#include "run/script/script.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace cascade {

struct AnalyzeRequest {
    /// The name of a stage, or its number, counted from 1. Empty: the first stage.
    std::string stage;
    /// Parameters to vary. With one parameter, the analysis finds the critical values of that
    /// parameter. With two, it makes a map over both. If empty, the analysis finds critical values
    /// of every parameter that has a range.
    std::vector<VariedRange> varied;
    bool as_json = false;  ///< Whether the report is JSON. If not, it is sentences.
    /// The file to which the result is written, in the format of its ending. Empty: no file is
    /// written.
    std::filesystem::path output;
    /// The folder that stores the sizes of stages for later runs (SimulationOptions::kernel_cache).
    /// Empty: sizes are not stored.
    std::filesystem::path kernel_cache = {};
};

/// Whether an analysis can be written to a file with this ending. A file .svg or .png gets a plot,
/// and a file .json gets the report.
bool is_analysis_output(const std::filesystem::path& path);

struct AnalyzeReport {
    std::string text;  ///< The report for standard output.
    std::vector<std::filesystem::path> written;
};

/// Analyses a stage. Fails if the stage is of a kind without flat states, if its requested size
/// cannot be computed, if a parameter cannot be varied, or if the output cannot be written.
Result<AnalyzeReport> analyze(Script& script, const AnalyzeRequest& request);

}  // namespace cascade
