// Records how much the cells of a stage differ from each other, from the start of the stage to its
// end.
#pragma once

#include "core/plane.h"
#include "core/spread.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// The species of a stage at one moment.
struct Moment {
    std::int64_t step = 0;
    double age = 0;  ///< The stage's time. The number of steps if `speed` varies.
    /// The spread of each species. If there are many cells, only some rows are read.
    std::vector<Spread> species;
    /// Whether every species has the same value in all cells, except for rounding errors.
    bool is_uniform = false;
    std::vector<double> largest;  ///< For each species, the largest absolute value so far.
};

/// The change of the pattern at the end of a stage.
enum class Trend {
    none,     ///< The pattern neither grows nor fades.
    growing,  ///< The amplitude of every species rises, so more steps would change the picture.
    fading,   ///< Small remains of an earlier pattern still decrease.
};

/// Records some moments of a stage, roughly equally far apart in steps. Stores numbers, and no
/// planes. Reads rows with at most some ten thousand cells in all, with vector instructions.
/// Without that limit on cells, recording took 7 % of the time of 28,000 steps of 128² cells.
class StageCourse {
public:
    bool empty() const { return moments_.empty(); }
    /// Whether the state after this step should be recorded.
    bool is_due(std::int64_t step) const;
    /// Adds the present moment to the record, or replaces the last moment if it has the same step.
    /// If `inside` is given, only cells in which it is not 0 count.
    void look(std::int64_t step, double age, std::span<const Field> species, const Mask* inside);

    /// Adds the estimated errors, as a fraction of the values, of the steps up to `age`. Earlier
    /// errors are first multiplied by (a / b)², where a is the age of the previous call and b is
    /// `age`, because later states depend less and less on early ones.
    void add_errors(double age, double part);
    /// Returns the sum of all errors divided by the contrast at the last moment. For each species,
    /// the deviation is divided by the root mean square. The contrast is the largest of these
    /// quotients.
    double errors() const;

    const Moment& first() const { return moments_.front(); }
    const Moment& last() const { return moments_.back(); }
    bool ended_uniform() const { return !empty() && last().is_uniform; }
    /// Returns the first moment since which all species have been uniform. May be called only if
    /// ended_uniform() is true.
    const Moment& uniform_since() const;
    /// For each species, the largest deviation so far is divided by the largest absolute value so
    /// far. Returns the largest of these quotients.
    double greatest_contrast() const;

    Trend trend() const;
    /// Returns, for a growing pattern, the relative increase of a species' deviation over the last
    /// tenth of the stage's age.
    double growth(std::size_t species) const;

private:
    const Moment& at_age(double part) const;
    double largest_seen(std::size_t species, double (Spread::*what)() const) const;
    bool is_growing(std::size_t species) const;

    std::vector<Moment> moments_;
    std::int64_t steps_between_ = 1;
    double errors_ = 0, age_of_errors_ = 0;
};

}  // namespace cascade
