// `cascade analyze`: what will grow, from the equations alone. Takes no step, except for the trial
// run of a stage with a size.
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
    std::string stage;  ///< Name, or number from 1; empty for the first one.
    /// Without one, critical values of every parameter that has a range; with one, of this one;
    /// with two, a map over both.
    std::vector<VariedRange> varied;
    bool as_json = false;          ///< The report is JSON instead of words.
    std::filesystem::path output;  ///< A file for the result, by its ending; may be empty.
    /// Where the sizes of stages are kept (SimulationOptions::kernel_cache); empty: nowhere.
    std::filesystem::path kernel_cache = {};
};

/// The endings that an output may have: .svg and .png, a plot; .json.
bool is_analysis_output(const std::filesystem::path& path);

struct AnalyzeReport {
    std::string text;  ///< For standard output.
    std::vector<std::filesystem::path> written;
};

/// Fails if the stage has no flat states by its nature or cannot have its size, if a parameter
/// cannot be varied, or if the output cannot be written.
Result<AnalyzeReport> analyze(Script& script, const AnalyzeRequest& request);

/// A remark for each stage of fields from whose start no pattern can come, or whose diffusion is
/// negative, which its equations tell before it runs: "stage 'a': nothing will grow: no wave grows
/// from …".
std::vector<std::string> outlooks(const Script& script);
/// That of one stage, or nothing.
std::string outlook(const Program& program, std::uint32_t stage);

}  // namespace cascade
