// NaNs that no species would show: in parameters, comparisons, bounds, conditions and the mask.
#pragma once

#include "core/run_control.h"
#include "lang/calculus/lost_numbers.h"
#include "run/simulation/stage_view.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// A part of a formula that may be NaN unnoticed.
struct UndefinedWatch {
    std::string where;   ///< A description of its place.
    const char* effect;  ///< The effect of a NaN there.
    LostNumber number;
};

/// Warns of such values in a stage that is run. Coarser grids are skipped, because they would
/// repeat the warnings of the full grid.
class UndefinedValues {
public:
    /// Called before the first step of a stage and at its end; gives one warning for both.
    void look_at_start(const StageView& view, const RunControl& control);
    void look_at_end(const StageView& view, const RunControl& control);
    /// Called whenever `until` is evaluated.
    void look_at_until(const StageView& view, const RunControl& control);

private:
    bool is_told_ = false;
    bool until_is_told_ = false;
    std::optional<std::vector<UndefinedWatch>> in_until_;
};

/// `evaluate` returns the first result of a plan of the mask.
void warn_of_undefined_mask(const Environment& environment,
                            const std::function<Field(const StepPlan&)>& evaluate,
                            const RunControl& control);
/// Warns of pictures that a script reads and that have a single level.
void warn_of_even_pictures(const Environment& environment, const RunControl& control);

}  // namespace cascade
