// The changes that a user can make to a running cascade.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace cascade {

/// Replaces the script. A stage, species or parameter that both scripts have, by its name, keeps
/// its values.
struct SetText {
    std::string text;
    bool operator==(const SetText&) const = default;
};

/// Sets a parameter or setting, as `--set NAME=EXPR` does. Replaces an earlier
/// SetNumber of the same name.
struct SetNumber {
    std::string name;  ///< `ka` for all stages, or `spots.ka` for one stage.
    std::string expression;
    bool operator==(const SetNumber&) const = default;
};

/// Gives new values to the cells of the current stage: to a species, or to a parameter or `frozen`
/// if it varies by cell. A stroke mixes new values with the old ones: `b: mix(b, 8, disc(20, 30,
/// 5))`. In a stage of crawling cells, the item `remove` removes each cell in which the expression
/// is not 0.
struct Paint {
    std::string item;
    std::string expression;  ///< Evaluated at the present state, as expressions for pictures are.
    bool operator==(const Paint&) const = default;
};

/// Sets every cell of the current stage to a given number, without an expression.
struct SetValues {
    std::string item;
    /// A value for each cell. On a grid, the cells are ordered row by row and slice by slice. On a
    /// model and for crawling cells, they are in the order of their numbers. Values outside a mask
    /// are ignored.
    std::vector<double> values;
    bool operator==(const SetValues&) const = default;
};

/// Ends the current stage at its present step, and begins the next stage.
struct NextStage {
    bool operator==(const NextStage&) const = default;
};

using Change = std::variant<SetText, SetNumber, Paint, SetValues, NextStage>;

/// Whether the change affects the script, and not only values.
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
