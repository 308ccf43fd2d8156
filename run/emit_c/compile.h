// `cascade compile`: a stage as an object file with a C header.
#pragma once

#include "core/result.h"
#include "run/script/script.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// The most stages of a step of rkl1 or rkl2.
inline constexpr std::int64_t most_compiled_stages = 99;

struct CompileRequest {
    std::optional<std::string> stage = {};   ///< Name or number from 1; empty for the first.
    std::vector<std::string> per_cell = {};  ///< Uniform parameters that get a plane nevertheless.
    std::string target = {};                 ///< A processor name; "" for this machine's.
    std::string function_name = {};          ///< "" derives it from the script's name.
    std::optional<std::uint32_t> stages = {};  ///< Of a step of rkl1 or rkl2: odd, from 3.
    /// Where the sizes of stages are kept (SimulationOptions::kernel_cache); empty: nowhere.
    std::filesystem::path kernel_cache = {};
};

struct CompiledStep {
    std::vector<std::uint8_t> object;
    std::string header;
};

/// Compiles one stage for the script's grid. Errors of the request are Failures; those in files
/// that the script reads are added to its diagnostics, and the result is a Failure, too.
Result<CompiledStep> compile_step(Script& script, const CompileRequest& request);

}  // namespace cascade
