// Lack of memory as a failure. What asks for memory throws std::bad_alloc; where programs have no
// exceptions, as in WebAssembly, it ends the program instead.
#pragma once

#include "core/result.h"

#include <cstdlib>
#include <new>
#include <string>

namespace cascade {

/// Says that there is too little memory.
[[noreturn]] inline void lack_memory() {
#ifdef __cpp_exceptions
    throw std::bad_alloc();
#else
    std::abort();
#endif
}

/// The result of an action, a Result; a failure with this message if there was too little memory
/// for it.
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
