// Results of operations that can fail for external reasons: files, memory, a diverging run.
// Mistakes in a user's text are Diagnostics, and bugs of Cascade are CHECKs.
#pragma once

#include <tl/expected.hpp>

#include <string>

namespace cascade {

/// Explains to the user why an operation failed. `hint` says what to do about it and may be empty.
struct Failure {
    std::string message;
    std::string hint;
};

template <typename T>
using Result = tl::expected<T, Failure>;

inline tl::unexpected<Failure> failure(std::string message, std::string hint = "") {
    return tl::unexpected<Failure>({std::move(message), std::move(hint)});
}

}  // namespace cascade
