// The options of `cascade run` as an enumeration, so that checks can refer to them.
#pragma once

#include "run/commands/run.h"

#include <string>

namespace cascade {

enum class RunOption {
#define CASCADE_PICTURE_OPTION(type, member, ...) member,
#include "run/script/picture_options.def"
#define CASCADE_RUN_OPTION(id, ...) id,
#include "run/commands/run_options.def"
};

/// Returns the option as users type it, such as "--space-time".
std::string flag_of(RunOption option);
/// Whether the value of the option differs from its default.
bool is_given(const RunRequest& request, RunOption option);

}  // namespace cascade
