// A failure as one line of text.
#pragma once

#include "core/result.h"

#include <string>

namespace cascade {

/// "message (hint)", or the message alone if there is no hint.
inline std::string line_of(const Failure& failure) {
    return failure.hint.empty() ? failure.message : failure.message + " (" + failure.hint + ")";
}

}  // namespace cascade
