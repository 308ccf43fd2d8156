// The course of a stage: how much its cells differed from each other, from start to end.
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
    double age = 0;               ///< Its time, or its steps if the time varies by cell.
    std::vector<Spread> species;  ///< Over some of the rows if there are many cells.
    bool is_even = false;         ///< All species are even over all cells.
    std::vector<double> largest;  ///< By species: the largest magnitude so far.
};

/// How the pattern of a stage changes at its end.
enum class Trend {
    none,     ///< Neither of the two below.
    growing,  ///< Its amplitude rises in every species; more steps would change the picture.
    fading,   ///< The small remains of an earlier pattern still decrease.
};

/// Remembers a few moments of a stage, spread roughly evenly over its steps. It keeps numbers only,
/// so it costs no planes, and reads rows of some ten thousand cells at most, in vectors. Before it
/// did so, all moments of 28,000 steps of 128² cells took 7 % of their time.
class StageCourse {
public:
    bool empty() const { return moments_.empty(); }
    /// Is another moment due?
    bool is_due(std::int64_t step) const;
    /// Adds a moment, or replaces the last one if that has the same step. With `inside`, cells
    /// count where it is not 0.
    void look(std::int64_t step, double age, std::span<const Field> species, const Mask* inside);

    /// Adds the estimated errors of the steps up to this age, as a part of the values. Those of
    /// steps before count as the square of their part of the age: patterns forget how they began.
    void add_errors(double age, double part);
    /// Their sum over the contrast at the last moment: the largest deviation of a species, as a
    /// part of its root mean square.
    double errors() const;

    const Moment& first() const { return moments_.front(); }
    const Moment& last() const { return moments_.back(); }
    bool ended_even() const { return !empty() && last().is_even; }
    /// The first of the even moments at the end; only if the stage ended even.
    const Moment& even_since() const;
    /// The largest deviation of a species so far, divided by its largest magnitude so far; the
    /// maximum over all species.
    double greatest_contrast() const;

    Trend trend() const;
    /// For a growing pattern: by which part the deviation of a species rose over the last tenth of
    /// the stage's age.
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
