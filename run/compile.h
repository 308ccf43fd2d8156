// `cascade compile`: a stage's step kernel as an object file with a C header.
#pragma once

#include "core/result.h"
#include "run/script.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

struct CompileRequest {
    std::optional<std::string> stage;     ///< By name or number from 1; empty: the first stage.
    std::vector<std::string> per_cell;    ///< Parameters that shall be planes even if uniform.
    std::string target;                   ///< CPU name; "" is this machine's.
    std::string function_name;            ///< "" makes one of the script's name.
};

struct CompiledStep {
    std::vector<std::uint8_t> object;
    std::string header;
};

/// Compiles the step of one stage. Faults of the request are Failures.
Result<CompiledStep> compile_step(const Script& script, const CompileRequest& request);

}  // namespace cascade
