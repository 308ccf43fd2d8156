// Turns the std::bad_alloc of a failed allocation into a Failure. Without exceptions, as in
// WebAssembly, a failed allocation ends the program.
#pragma once

#include "core/result.h"

#include <cstdlib>
#include <new>
#include <string>

namespace cascade {

/// Reports a lack of memory as a failed allocation does: throws std::bad_alloc or ends the program.
[[noreturn]] inline void lack_memory() {
#ifdef __cpp_exceptions
    throw std::bad_alloc();
#else
    std::abort();
#endif
}

/// Calls `action` and returns its Result, or a failure with `message` if memory ran out.
template <typename Action>
auto enough_memory_for(const Action& action,
                       const std::string& message = "there is not enough memory")
    -> decltype(action()) {
#ifdef __cpp_exceptions
    try {
        return action();
    } catch (const std::bad_alloc&) {
        return failure(message);
    }
#else
    static_cast<void>(message);
    return action();
#endif
}

}  // namespace cascade
