// The command `cascade compile` compiles a stage to an object file with a C header.
#pragma once

#include "core/result.h"
#include "run/script/script.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// The largest number of stages of a step by the solvers rkl1 and rkl2.
inline constexpr std::int64_t most_compiled_stages = 99;

struct CompileRequest {
    /// The name of a stage, or its number, counted from 1. Empty: the first stage.
    std::optional<std::string> stage = {};
    /// Names of parameters that get a plane although they are uniform.
    std::vector<std::string> per_cell = {};
    std::string target = {};  ///< The name of a processor. Empty: the processor of this machine.
    /// The prefix of the functions' names. Empty: derived from the script's name.
    std::string function_name = {};
    /// The number of stages of a step by the solvers rkl1 and rkl2. Odd, and at least 3.
    std::optional<std::uint32_t> stages = {};
    /// The folder that stores the sizes of stages for later runs (SimulationOptions::kernel_cache).
    /// Empty: sizes are not stored.
    std::filesystem::path kernel_cache = {};
};

struct CompiledStep {
    std::vector<std::uint8_t> object;
    std::string header;
};

/// Compiles one stage for the script's grid. Fails if the request has errors. Errors in files that
/// the script reads are added to its diagnostics, and the call then fails, too.
Result<CompiledStep> compile_step(Script& script, const CompileRequest& request);

}  // namespace cascade
