// Values that are not numbers where no species would ever show it: in parameters, comparisons,
// bounds, conditions and the mask.
#pragma once

#include "core/run_control.h"
#include "lang/calculus/lost_numbers.h"
#include "run/simulation/stage_view.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// A part of a formula whose value would be no number without anybody noticing.
struct UndefinedWatch {
    std::string where;   ///< It stands, in words.
    const char* effect;  ///< Of its being none.
    LostNumber number;
};

/// Warns of such values in a stage that is run. Coarser grids say nothing: they would repeat what
/// the full one says.
class UndefinedValues {
public:
    /// Before the first step of a stage, and at its end: one warning for both.
    void look_at_start(const StageView& view, const RunControl& control);
    void look_at_end(const StageView& view, const RunControl& control);
    /// Whenever `until` is evaluated.
    void look_at_until(const StageView& view, const RunControl& control);

private:
    bool is_told_ = false;
    bool until_is_told_ = false;
    std::optional<std::vector<UndefinedWatch>> in_until_;
};

/// `evaluate` gives the first result of a plan of the mask.
void warn_of_undefined_mask(const Environment& environment,
                            const std::function<Field(const StepPlan&)>& evaluate,
                            const RunControl& control);
/// Pictures that a script reads and that have one level alone.
void warn_of_even_pictures(const Environment& environment, const RunControl& control);

}  // namespace cascade
