// Results of work that can fail for reasons outside the program: files, memory, a run that blows
// up. Mistakes in a user's text are Diagnostics instead; our own mistakes are CHECKs.
#pragma once

#include <tl/expected.hpp>

#include <string>

namespace cascade {

/// Why it failed, in words for the user, and what can be done about it (may be empty).
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
