// `--dump wgsl`: the kernels of steps in WGSL, the language of WebGPU.
#pragma once

#include "core/result.h"
#include "lang/program/program.h"

#include <string>
#include <string_view>

namespace cascade {

inline constexpr std::string_view wgsl_kind = "wgsl";

/// Writes a program in WGSL for one step of each stage. Fails for stages in double precision and
/// for models, whose cells are known only in a run.
Result<std::string> dump_wgsl(const Program& program);

}  // namespace cascade
