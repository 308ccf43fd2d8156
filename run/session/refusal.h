// The reasons for which a running cascade refuses a request.
#pragma once

#include "core/diagnostics.h"
#include "core/result.h"
#include "run/script/script.h"

#include <optional>
#include <string>

namespace cascade {

/// The reason why a change was refused: messages about a text, a failure, or both.
struct Refusal {
    Diagnostics diagnostics;
    Sources sources;  ///< The sources of the diagnostics.
    std::optional<Failure> failure;

    /// Returns all messages as text, as the command line prints them.
    std::string messages(bool colour) const;
    /// Returns the failure or, if there is none, the first error as a failure without a position.
    Failure in_brief() const;
};

template <typename T>
using Accepted = tl::expected<T, Refusal>;

tl::unexpected<Refusal> refuse(Failure failure);
tl::unexpected<Refusal> refuse(std::string message, std::string hint = "");
/// Refuses a script because of its errors, without its warnings. If the script has no errors,
/// refuses it because of `failure`.
tl::unexpected<Refusal> refuse(Script script, std::optional<Failure> failure = {});

}  // namespace cascade
