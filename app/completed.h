// The words that can follow an option or be an argument, for shell completions.
#pragma once

#include "app/manual.h"

#include <string>
#include <vector>

namespace cascade {

/// The possible values of an option or argument. Values that are neither files nor words, such as
/// numbers and formulas, cannot be completed.
struct Completed {
    enum class Kind { nothing, words, files, folders };
    Kind kind = Kind::nothing;
    std::vector<std::string> words;
    /// The endings of possible files, such as ".cascade". Empty if any file is possible.
    std::vector<std::string> endings;
};

/// Derives the values of an option from the placeholder of its value: "FILE.csv", "sun|studio".
Completed values_of(const ManualOption& option);
/// Derives the values of a command's arguments from their placeholders.
Completed arguments_of(const ManualCommand& command);

}  // namespace cascade
