// Detects NaNs that would go unnoticed because they do not spread to a species: in parameters,
// comparisons, bounds, conditions and the mask.
#pragma once

#include "core/run_control.h"
#include "lang/calculus/lost_numbers.h"
#include "run/simulation/stage_view.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// A part of a formula that may become NaN without notice.
struct UndefinedWatch {
    std::string where;   ///< Where the part is in the script, in words.
    const char* effect;  ///< What a NaN there causes, in words.
    LostNumber number;
};

/// Warns of unnoticed NaNs in a stage that runs. Does not warn on coarser grids, because the full
/// grid gives the same warnings.
class UndefinedValues {
public:
    /// look_at_start() must be called before the first step of a stage, and look_at_end() at the
    /// stage's end. Both together give at most one warning.
    void look_at_start(const StageView& view, const RunControl& control);
    void look_at_end(const StageView& view, const RunControl& control);
    /// Must be called whenever `until` is evaluated.
    void look_at_until(const StageView& view, const RunControl& control);

private:
    bool is_told_ = false;
    bool until_is_told_ = false;
    std::optional<std::vector<UndefinedWatch>> in_until_;
};

/// Warns of NaNs in the formula of the mask. `evaluate` returns the first result of a plan.
void warn_of_undefined_mask(const Environment& environment,
                            const std::function<Field(const StepPlan&)>& evaluate,
                            const RunControl& control);
/// Warns of picture files that a script reads and that have the same grey in all pixels.
void warn_of_uniform_pictures(const Environment& environment, const RunControl& control);

}  // namespace cascade
