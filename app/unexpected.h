// Reports exceptions that end a command.
#pragma once

#include "app/console.h"

namespace cascade {

/// Must be called while an exception is handled. Describes the exception, and returns the exit
/// status.
int tell_of_exception(const Console& console);

}  // namespace cascade
