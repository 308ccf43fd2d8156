// The options of `cascade run` as values, for checks.
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

/// As it is typed, such as "--space-time".
std::string flag_of(RunOption option);
/// Whether it has another value than the initial one.
bool is_given(const RunRequest& request, RunOption option);

}  // namespace cascade
