// Why a running cascade refuses what it is asked for.
#pragma once

#include "core/diagnostics.h"
#include "core/result.h"
#include "run/script/script.h"

#include <optional>
#include <string>

namespace cascade {

/// Why a change was refused: messages about a text, or a failure, or both.
struct Refusal {
    Diagnostics diagnostics;
    Sources sources;  ///< Of the diagnostics.
    std::optional<Failure> failure;

    /// All of it as text, as the command line draws it.
    std::string messages(bool colour) const;
    /// The failure, or else the first error without its place.
    Failure in_brief() const;
};

template <typename T>
using Accepted = tl::expected<T, Refusal>;

tl::unexpected<Refusal> refuse(Failure failure);
tl::unexpected<Refusal> refuse(std::string message, std::string hint = "");
/// The errors of a script that is not used, without its warnings; the failure if it has none.
tl::unexpected<Refusal> refuse(Script script, std::optional<Failure> failure = {});

}  // namespace cascade
