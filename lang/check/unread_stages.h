// Warnings about stages that neither a later stage nor a picture reads.
#pragma once

#include "core/diagnostics.h"
#include "lang/program/program.h"

#include <cstdint>

namespace cascade {

/// Warns of every stage that nothing reads. `shown` is the stage whose picture is drawn and counts
/// as read, like the stages that `picture` (or nullptr) reads. A stage that reads nothing is not
/// reported if it is read itself.
void warn_of_unread_stages(const Program& program, std::uint32_t shown, const Formula* picture,
                           Diagnostics& diagnostics);

}  // namespace cascade
