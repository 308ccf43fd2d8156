// Stages for nothing: those that no later stage and no picture reads.
#pragma once

#include "core/diagnostics.h"
#include "lang/program/program.h"

#include <cstdint>

namespace cascade {

/// Warns of every stage that nothing reads. `shown` is the stage whose picture is drawn, and
/// `picture` what that computes, or nullptr; what is drawn is read. A stage is no fault for reading
/// nothing, if it is read.
void warn_of_unread_stages(const Program& program, std::uint32_t shown, const Formula* picture,
                           Diagnostics& diagnostics);

}  // namespace cascade
