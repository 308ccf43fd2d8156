// Changes that a user makes to a running cascade, as values.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

namespace cascade {

/// Sets another script. Stages, species and parameters of the same name keep their values.
struct SetText {
    std::string text;
    bool operator==(const SetText&) const = default;
};

/// Sets a parameter or setting, as `--set NAME=EXPR` does. Replaces an earlier one of the same
/// name.
struct SetNumber {
    std::string name;  ///< `ka`, or `spots.ka` for one stage.
    std::string expression;
    bool operator==(const SetNumber&) const = default;
};

/// Sets other values in the cells of the current stage: of a species, or of a parameter or `frozen`
/// that varies. A stroke blends them into the old ones: `b: mix(b, 8, disc(20, 30, 5))`. In a stage
/// of crawling cells `remove` removes the cells where the expression is not 0.
struct Paint {
    std::string item;
    std::string expression;  ///< Over the present state, as for pictures.
    bool operator==(const Paint&) const = default;
};

/// Ends the current stage at its present step and begins the next one.
struct NextStage {
    bool operator==(const NextStage&) const = default;
};

using Change = std::variant<SetText, SetNumber, Paint, NextStage>;

/// Does it change the script, and not only values?
inline bool is_of_script(const Change& change) {
    return std::holds_alternative<SetText>(change) || std::holds_alternative<SetNumber>(change);
}

/// A moment of a run: a stage, by its position, and its number of complete steps.
struct RunPlace {
    std::uint32_t stage = 0;
    std::int64_t steps = 0;
    auto operator<=>(const RunPlace&) const = default;
};

struct LoggedChange {
    RunPlace at;
    Change change;
    bool operator==(const LoggedChange&) const = default;
};

}  // namespace cascade
