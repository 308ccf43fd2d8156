// Stores a limited number of moments. When there are too many, every second one is dropped. Trends
// are judged by tenths of the stage's age.
#include "run/stage/stage_course.h"

#include "solvers/field_norms.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace cascade {

namespace {

/// When there are this many moments, every second one is dropped.
constexpr std::size_t most_moments = 40;
/// If a plane has more cells than this, only some rows are read.
constexpr std::int64_t most_cells_seen = 1 << 14;

/// A pattern is growing if deviation and range of every species have risen in each of the last
/// three tenths of the stage's age, and if both have risen by at least this fraction in the last
/// tenth. Such a pattern would become at least 1.5 times as strong if the stage ran for twice the
/// time. Fronts that fill a plane and patterns that coarsen keep their range. Waves and pulses do
/// not rise in all species for that long.
constexpr double least_growth = 0.05;

/// A pattern is fading if three conditions hold. The first condition: the deviation of each species
/// is at most this fraction of the species' largest magnitude so far.
constexpr double small_rest = 1e-3;
/// The second condition: the deviation is at most this fraction of the species' largest deviation
/// so far.
constexpr double part_of_before = 0.1;
/// The third condition: the deviation has fallen by this fraction over the last tenth of the
/// stage's age.
constexpr double least_fall = 0.05;

Spread spread_of_rows(const Field& field, const Mask* inside, std::int64_t every_row) {
    return field.visit([&](const auto& plane) {
        Spread spread;
        const PlaneLayout& layout = plane.layout();
        for (std::int64_t row = 0; row < layout.row_count(); row += every_row) {
            const std::span cells(plane.row(row), static_cast<std::size_t>(layout.width));
            spread.add(cascade::spread_of(cells, inside != nullptr ? inside->row(row) : nullptr));
        }
        return spread;
    });
}

/// Does the same as Spread::is_uniform() for every n-th row. Compares with the root mean square,
/// which is faster to compute than the largest magnitude and never exceeds it.
bool is_uniform(const Field& field, const Mask* inside, std::int64_t every_row, double once) {
    if (every_row == 1) {
        const FieldMoments all = moments(field, inside);
        if (all.deviation <
            std::max(uniform_deviation * all.root_mean_square, remaining_part * once))
            return true;
    }
    return spread_of_rows(field, inside, every_row).is_uniform(once);
}

double range(const Spread& spread) { return spread.largest - spread.smallest; }

}  // namespace

bool StageCourse::is_due(std::int64_t step) const {
    return moments_.empty() || step >= last().step + steps_between_;
}

void StageCourse::look(std::int64_t step, double age, std::span<const Field> species,
                       const Mask* inside) {
    if (species.empty()) return;
    if (!moments_.empty() && last().step >= step) moments_.pop_back();
    if (moments_.size() >= most_moments) {
        // The first moment stays, because it is the start of the stage.
        std::size_t kept = 1;
        for (std::size_t k = 2; k < moments_.size(); k += 2)
            moments_[kept++] = std::move(moments_[k]);
        moments_.resize(kept);
        steps_between_ =
            std::max<std::int64_t>(1, step / static_cast<std::int64_t>(most_moments / 2));
    }
    const PlaneLayout& layout = species[0].layout();
    const std::int64_t every_row =
        std::max<std::int64_t>(1, layout.width * layout.row_count() / most_cells_seen);
    Moment moment{step, age, {}, true, {}};
    for (std::size_t k = 0; k < species.size(); ++k) {
        const Spread& spread =
            moment.species.emplace_back(spread_of_rows(species[k], inside, every_row));
        const double before = moments_.empty() ? 0 : last().largest[k];
        moment.largest.push_back(std::max(before, spread.magnitude()));
        moment.is_uniform = moment.is_uniform && spread.is_uniform(moment.largest[k]);
    }
    // A small feature may be hidden between the rows that were read.
    for (std::int64_t rows = every_row; moment.is_uniform && rows > 1;) {
        rows = std::max<std::int64_t>(1, rows / 16);
        for (std::size_t k = 0; k < species.size(); ++k) {
            moment.is_uniform =
                moment.is_uniform && is_uniform(species[k], inside, rows, moment.largest[k]);
        }
    }
    moments_.push_back(std::move(moment));
}

void StageCourse::add_errors(double age, double part) {
    if (!(age > age_of_errors_)) return;
    const double before = age_of_errors_ / age;
    errors_ = errors_ * before * before + part;
    age_of_errors_ = age;
}

double StageCourse::errors() const {
    double contrast = 0;
    for (const Spread& spread : last().species) {
        const double size = std::hypot(spread.mean, spread.deviation());
        if (size > 0) contrast = std::max(contrast, spread.deviation() / size);
    }
    return contrast > 0 ? errors_ / contrast : 0;
}

const Moment& StageCourse::uniform_since() const {
    std::size_t k = moments_.size() - 1;
    while (k > 0 && moments_[k - 1].is_uniform) --k;
    return moments_[k];
}

double StageCourse::largest_seen(std::size_t species, double (Spread::*what)() const) const {
    double largest = 0;
    for (const Moment& moment : moments_) {
        largest = std::max(largest, (moment.species[species].*what)());
    }
    return largest;
}

double StageCourse::greatest_contrast() const {
    double greatest = 0;
    for (std::size_t k = 0; k < last().species.size(); ++k) {
        const double magnitude = largest_seen(k, &Spread::magnitude);
        if (magnitude > 0)
            greatest = std::max(greatest, largest_seen(k, &Spread::deviation) / magnitude);
    }
    return greatest;
}

/// Returns the moment nearest to this fraction of the present age.
const Moment& StageCourse::at_age(double part) const {
    const double age = part * last().age;
    return *std::min_element(moments_.begin(), moments_.end(),
                             [&](const Moment& a, const Moment& b) {
                                 return std::abs(a.age - age) < std::abs(b.age - age);
                             });
}

double StageCourse::growth(std::size_t species) const {
    const Moment& before = at_age(0.9);
    const double ratio = last().species[species].deviation() / before.species[species].deviation();
    const double tenths = 10 * (last().age - before.age) / last().age;
    return std::pow(ratio, 1 / tenths) - 1;
}

bool StageCourse::is_growing(std::size_t species) const {
    const std::array<const Moment*, 4> course = {&at_age(0.7), &at_age(0.8), &at_age(0.9), &last()};
    for (std::size_t k = 1; k < course.size(); ++k) {
        // If moments are too far apart, the same moment is nearest to two of these ages, and
        // nothing is known of the time between them.
        if (course[k]->step <= course[k - 1]->step) return false;
        const Spread& before = course[k - 1]->species[species];
        const Spread& now = course[k]->species[species];
        if (!(now.deviation() > before.deviation() && range(now) > range(before))) return false;
    }
    const Spread& before = course[2]->species[species];
    const double tenths = 10 * (last().age - course[2]->age) / last().age;
    const double least = std::pow(1 + least_growth, tenths);
    return last().species[species].deviation() >= least * before.deviation() &&
           range(last().species[species]) >= least * range(before);
}

Trend StageCourse::trend() const {
    if (moments_.size() < 2 || last().is_uniform || !(last().age > 0)) return Trend::none;
    const Moment& before = at_age(0.9);
    if (before.step == last().step) return Trend::none;
    bool grows = true, fades = true, differs = false;
    for (std::size_t k = 0; k < last().species.size(); ++k) {
        const Spread& now = last().species[k];
        if (now.is_uniform(last().largest[k])) continue;
        differs = true;
        grows = grows && is_growing(k);
        fades = fades && now.deviation() <= small_rest * largest_seen(k, &Spread::magnitude) &&
                now.deviation() <= part_of_before * largest_seen(k, &Spread::deviation) &&
                now.deviation() <= (1 - least_fall) * before.species[k].deviation();
    }
    if (!differs) return Trend::none;
    return grows ? Trend::growing : fades ? Trend::fading : Trend::none;
}

}  // namespace cascade
