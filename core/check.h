// CHECK asserts a condition that only a bug in Cascade can violate. It is not for users' mistakes.
#pragma once

namespace cascade {

/// Prints the location, the condition and the explanation to the error stream and aborts.
[[noreturn]] void check_failed(const char* file, int line, const char* condition, const char* why);

}  // namespace cascade

#define CHECK(condition, why)                                                         \
    do {                                                                              \
        if (!(condition)) cascade::check_failed(__FILE__, __LINE__, #condition, why); \
    } while (false)
