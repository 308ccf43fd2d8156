// `cascade compile`: a stage as an object file with a C header.
#pragma once

#include "core/result.h"
#include "run/script/script.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// The most stages of a step of rkl1 or rkl2.
inline constexpr std::int64_t most_compiled_stages = 99;

struct CompileRequest {
    std::optional<std::string> stage = {};   ///< By name or number from 1; empty: the first stage.
    std::vector<std::string> per_cell = {};  ///< Parameters that shall be planes even if uniform.
    std::string target = {};                 ///< CPU name; "" is this machine's.
    std::string function_name = {};          ///< "" makes one of the script's name.
    std::optional<std::uint32_t> stages = {};  ///< Of a step of rkl1 or rkl2: an odd number from 3.
};

struct CompiledStep {
    std::vector<std::uint8_t> object;
    std::string header;
};

/// Compiles one stage for the script's grid. Faults of the request are Failures; those of files
/// that the script reads are added to its diagnostics, and the result fails.
Result<CompiledStep> compile_step(Script& script, const CompileRequest& request);

}  // namespace cascade
