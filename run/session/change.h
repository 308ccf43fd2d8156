// The changes that a user can make to a running cascade.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace cascade {

/// Replaces the script. Stages, species and parameters with the same name in both scripts keep
/// their values.
struct SetText {
    std::string text;
    bool operator==(const SetText&) const = default;
};

/// Sets a parameter or setting, as `--set NAME=EXPR` does. Replaces an earlier
/// SetNumber of the same name.
struct SetNumber {
    std::string name;  ///< `ka`, or `spots.ka` for one stage.
    std::string expression;
    bool operator==(const SetNumber&) const = default;
};

/// Gives new values to the cells of the current stage, for a species, or for a parameter or
/// `frozen` that varies. A stroke mixes new values with the old ones: `b: mix(b, 8, disc(20, 30,
/// 5))`. In a stage of crawling cells, the item `remove` removes each cell in which the
/// expression is not 0.
struct Paint {
    std::string item;
    std::string expression;  ///< Evaluated at the present state, like expressions for pictures.
    bool operator==(const Paint&) const = default;
};

/// Sets every cell of the current stage to a given number. Paint evaluates an expression instead.
struct SetValues {
    std::string item;
    /// One for each cell. On a grid they are row by row and slice by slice. On a model and for
    /// crawling cells they are in the order of the cells' numbers. Values outside a mask are
    /// ignored.
    std::vector<double> values;
    bool operator==(const SetValues&) const = default;
};

/// Ends the current stage at its present step and begins the next one.
struct NextStage {
    bool operator==(const NextStage&) const = default;
};

using Change = std::variant<SetText, SetNumber, Paint, SetValues, NextStage>;

/// Whether the change affects the script rather than only values.
inline bool is_of_script(const Change& change) {
    return std::holds_alternative<SetText>(change) || std::holds_alternative<SetNumber>(change);
}

/// Whether the change is a stroke, which replaces values of cells.
inline bool is_stroke(const Change& change) {
    return std::holds_alternative<Paint>(change) || std::holds_alternative<SetValues>(change);
}

/// A moment of a run: the index of a stage, and its number of complete steps.
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
