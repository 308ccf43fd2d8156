// What a user does to a cascade while it runs, as values.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

namespace cascade {

/// Another script. Stages, species and parameters of the same name keep their values.
struct SetText {
    std::string text;
    bool operator==(const SetText&) const = default;
};

/// Another value of a parameter or setting, as `--set NAME=EXPR` gives it; replaces an earlier one
/// of the same name.
struct SetNumber {
    std::string name;  ///< `ka`, or `spots.ka` for one stage.
    std::string expression;
    bool operator==(const SetNumber&) const = default;
};

/// Other values in the cells of the current stage: of a species, or of a parameter or `frozen` that
/// varies. A stroke blends them into the old ones: `b: mix(b, 8, disc(20, 30, 5))`. In a stage of
/// cells that crawl `remove` takes the cells away where the expression is not 0.
struct Paint {
    std::string item;
    std::string expression;  ///< Over the present state, as for pictures.
    bool operator==(const Paint&) const = default;
};

/// The current stage ends at its present step, and the next one begins.
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
