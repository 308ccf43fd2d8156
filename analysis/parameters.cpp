// Follows a flat state along values of a parameter. Newton's method finds each state from the
// previous one.
#include "analysis/parameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace cascade::analysis {

namespace {

struct Place {
    std::optional<Vector> state;
    std::optional<Stability> stability;
    double cells = std::numeric_limits<double>::quiet_NaN();
};

/// A flat state of a model at any values of its varied parameters.
class Follower {
public:
    Follower(const LinearModel& model, const std::vector<double>& present, const Vector& state)
        : model_(model), rates_(model), sizes_(state.cwiseAbs()) {
        rates_.set_varied(present);
        conserved_ = conserved_totals(rates_);
        sizes_ = sizes_.cwiseMax(0.1 * std::max(sizes_.maxCoeff(), 1e-3));
    }

    /// The flat state near `beside`. Empty if Newton's method finds none or jumps to another.
    Place at(const std::vector<double>& values, const std::optional<Vector>& beside) {
        rates_.set_varied(values);
        // Conserved totals follow from the starting values, which may depend on the parameters.
        const bool has_totals = conserved_.rows() > 0;
        if (!beside && !has_totals) return {};
        const Vector guess = has_totals ? rates_.start() : *beside;
        if (!guess.allFinite()) return {};
        Place place;
        place.state = flat_state_near(rates_, guess, conserved_);
        if (place.state && !has_totals && has_jumped(guess, *place.state)) place.state.reset();
        if (!place.state) return place;
        const Matrices matrices = rates_.matrices(*place.state);
        if (!matrices.are_finite()) return {};
        const Dispersion relation = quick_dispersion(model_, matrices);
        place.stability = relation.stability;
        if (std::isfinite(relation.fastest.cells())) place.cells = relation.fastest.cells();
        return place;
    }

    /// Adds the equations of growing standing waves at a critical value of the only parameter.
    /// `step` is a small change of that parameter.
    void add_amplitudes(CriticalValue& change, const Place& beside, double step) {
        const auto at_value = [&](double value) {
            const Place place = at({value}, beside.state);
            return place.state;
        };
        const auto state = at_value(change.value);
        if (!state) return;
        const Dispersion relation = dispersion(model_, rates_.matrices(*state));
        change.amplitudes = amplitude_equations(rates_, *state, relation);
        if (!change.amplitudes || !change.amplitudes->ends_in_stripes()) return;
        const Lattice lattice = lattice_of(*model_.program);
        Phases phases{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            phases[axis] = relation.fastest.phase * relation.fastest.direction[axis];
        }
        const auto rate = [&](double value) {
            const auto there = at_value(value);
            return there ? eigenvalues(model_, rates_.matrices(*there), lattice, phases)[0].real()
                         : std::numeric_limits<double>::quiet_NaN();
        };
        const double slope = (rate(change.value + step) - rate(change.value - step)) / (2 * step);
        change.stripes = change.value + change.amplitudes->rate_of_stripes() / slope;
    }

private:
    /// Whether Newton's method has jumped to another flat state. A large change is no jump if the
    /// derivative of the state by the parameter predicts a change of that size.
    bool has_jumped(const Vector& from, const Vector& to) const {
        const Vector scale = sizes_.cwiseMax(from.cwiseAbs());
        const auto distance = [&](const Vector& change) {
            return change.cwiseQuotient(scale).cwiseAbs().maxCoeff();
        };
        const double moved = distance(to - from);
        if (moved <= 0.5) return false;
        const Vector slope = least_squares(rates_.jacobian(from), -rates_.rates(from));
        return !(distance(to - from - slope) <= 0.25 * moved);
    }

    const LinearModel& model_;
    LocalRates rates_;
    Matrix conserved_;
    Vector sizes_;
};

/// The value of a parameter in the script.
Result<double> present_value(const Program& program, std::uint32_t stage, ItemId item) {
    Algebra algebra;
    const StartValue start = start_values(algebra, program, stage, {})[item];
    const auto* number = algebra[start.value].as<double>();
    if (number == nullptr || start.is_unknown) {
        return failure("its present value is unknown");
    }
    return *number;
}

/// Finds the critical value between two values with different classes, by bisection. `step` is a
/// small change of the parameter.
CriticalValue bisected(Follower& follower, double low, double high, const Place& at_low,
                       const Place& at_high, double step) {
    Place below = at_low, above = at_high;
    const Place* known = below.state ? &below : &above;
    for (int round = 0; round < 24; ++round) {
        const double middle = (low + high) / 2;
        known = below.state ? &below : &above;
        Place place = follower.at({middle}, known->state);
        if (place.stability == below.stability) {
            below = std::move(place);
            low = middle;
        } else {
            above = std::move(place);
            high = middle;
        }
    }
    CriticalValue change{(low + high) / 2, below.stability, above.stability, 0, {}};
    const auto has_waves = [](const Place& place) {
        return place.stability == Stability::turing || place.stability == Stability::wave ||
               place.stability == Stability::both;
    };
    change.cells = has_waves(above)   ? above.cells
                   : has_waves(below) ? below.cells
                                      : std::numeric_limits<double>::quiet_NaN();
    const auto is_onset = [](const Place& a, const Place& b) {
        return a.stability == Stability::stable && b.stability == Stability::turing;
    };
    if (is_onset(below, above) || is_onset(above, below)) {
        follower.add_amplitudes(change, below, step);
    }
    return change;
}

}  // namespace

Result<ParameterScan> scan_parameter(const Program& program, std::uint32_t stage,
                                     const ParameterSpan& span, const Vector& state) {
    const std::array items{span.item};
    const auto model = linear_model(program, stage, items);
    if (!model) return tl::unexpected(model.error());
    const auto present = present_value(program, stage, span.item);
    if (!present) return tl::unexpected(present.error());
    Follower follower(*model, {*present}, state);
    ParameterScan scan{span, *present, {}, {}, {}};
    const int parts = model->species_count() <= 2 ? 64 : 32;
    const double middle = std::clamp(*present, span.low, span.high);
    // Values stay slightly inside the range, because a parameter that is 0 at an end of its range
    // may cause a division by 0.
    const double inwards = 1e-6 * (span.high - span.low);
    const double small = 1e-4 * (span.high - span.low);
    const auto walk = [&](double end) {
        double last = *present;
        Place before = follower.at({last}, state);
        // Changes of class on the way to the range from a value outside are not reported.
        if (middle != last) {
            for (int k = 1; k <= parts; ++k) {
                before = follower.at({last + (middle - last) * k / parts}, before.state);
            }
            last = middle;
        }
        for (int k = 1; k <= parts && end != middle; ++k) {
            const double value = k == parts ? end : middle + (end - middle) * k / parts;
            Place here = follower.at({value}, before.state);
            if (here.stability != before.stability) {
                scan.changes.push_back(value > last
                                           ? bisected(follower, last, value, before, here, small)
                                           : bisected(follower, value, last, here, before, small));
            }
            if (!here.state) return std::optional<Stability>();
            last = value;
            before = std::move(here);
        }
        return before.stability;
    };
    scan.at_low = walk(span.low + inwards);
    scan.at_high = walk(span.high - inwards);
    for (CriticalValue& change : scan.changes) {
        // A value much smaller than the range is 0 with a rounding error.
        if (std::abs(change.value) < 1e-8 * (span.high - span.low)) change.value = 0;
    }
    std::sort(scan.changes.begin(), scan.changes.end(),
              [](const auto& a, const auto& b) { return a.value < b.value; });
    return scan;
}

std::vector<ParameterSpan> ranged_parameters(const Program& program, std::uint32_t stage) {
    const System& system = program.system_of(stage);
    std::vector<ParameterSpan> spans;
    for (const ItemId item : system.quantities.ids()) {
        const Quantity& quantity = system.quantities[item];
        if (quantity.is_species || !quantity.range || !program.stages[stage].uniform[item]) {
            continue;
        }
        const std::array items{item};
        const auto model = linear_model(program, stage, items);
        if (!model) continue;
        // Keeps the parameter only if a formula reads it.
        const std::vector<NodeId> roots = model->formulas();
        const auto reads = [&](NodeId root) {
            const Formula formula = model->algebra.formula(root);
            return std::any_of(formula.nodes.begin(), formula.nodes.end(),
                               [&](const Node& node) { return node.is(item); });
        };
        if (std::any_of(roots.begin(), roots.end(), reads)) {
            spans.push_back({item, quantity.range->low, quantity.range->high});
        }
    }
    return spans;
}

namespace {

/// Finds the classes of a map: first along lines that are a block apart, then inside blocks whose
/// corners have different classes.
class MapFiller {
public:
    MapFiller(Follower& follower, const ParameterSpan& across, const ParameterSpan& up,
              std::size_t side)
        : follower_(follower), across_(across), up_(up), side_(side), places_(side * side) {
        for (std::size_t k = 0; k < side - 1; k += block) lines_.push_back(k);
        lines_.push_back(side - 1);
    }

    /// Follows the state from the script's own values along the middle row, then along columns.
    void follow_lines(const std::vector<double>& present, const Vector& state);
    /// The classes by row and column. The lines must be known.
    std::vector<std::optional<Stability>> classes();

private:
    static constexpr std::size_t block = 8;
    /// The number of steps from line to line. Small steps keep Newton's method at the same state.
    static constexpr int careful = 4;

    struct Block {
        std::size_t left, low, right, high;
        bool is_divisible() const { return right - left > 1 || high - low > 1; }
    };

    std::optional<Place>& place(std::size_t i, std::size_t j) { return places_[j * side_ + i]; }
    double value(const ParameterSpan& span, std::size_t k) const {
        return span.low +
               (span.high - span.low) * static_cast<double>(k) / static_cast<double>(side_ - 1);
    }
    std::size_t nearest_line(const ParameterSpan& span, double at) const;
    Place reach(const std::vector<double>& from, std::optional<Vector> beside, std::size_t i,
                std::size_t j, int parts);
    void fill(std::size_t i, std::size_t j, std::size_t beside_i, std::size_t beside_j, int parts);
    void fill_from_corner(const Block& at, std::size_t i, std::size_t j);
    bool is_uniform(const Block& at);
    void take_classes(const Block& at, std::vector<std::optional<Stability>>& classes);
    void divide(const Block& at, std::vector<Block>& waiting);

    Follower& follower_;
    const ParameterSpan &across_, &up_;
    std::size_t side_;
    std::vector<std::optional<Place>> places_;
    std::vector<std::size_t> lines_;
};

std::size_t MapFiller::nearest_line(const ParameterSpan& span, double at) const {
    std::size_t best = 0;
    for (std::size_t k = 0; k < lines_.size(); ++k) {
        if (std::abs(value(span, lines_[k]) - at) < std::abs(value(span, lines_[best]) - at)) {
            best = k;
        }
    }
    return best;
}

/// Finds the flat state at (i, j). Follows it in `parts` steps from the state `beside` at the
/// parameters `from`.
Place MapFiller::reach(const std::vector<double>& from, std::optional<Vector> beside, std::size_t i,
                       std::size_t j, int parts) {
    Place found;
    for (int k = 1; k <= parts; ++k) {
        const double part = static_cast<double>(k) / parts;
        found = follower_.at({from[0] + part * (value(across_, i) - from[0]),
                              from[1] + part * (value(up_, j) - from[1])},
                             beside);
        beside = found.state;
    }
    return found;
}

void MapFiller::fill(std::size_t i, std::size_t j, std::size_t beside_i, std::size_t beside_j,
                     int parts) {
    if (place(i, j)) return;
    const auto& beside = place(beside_i, beside_j);
    place(i, j) = reach({value(across_, beside_i), value(up_, beside_j)},
                        beside ? beside->state : std::nullopt, i, j, parts);
}

void MapFiller::follow_lines(const std::vector<double>& present, const Vector& state) {
    const std::size_t middle_i = nearest_line(across_, present[0]);
    const std::size_t middle_j = nearest_line(up_, present[1]);
    place(lines_[middle_i], lines_[middle_j]) =
        reach(present, state, lines_[middle_i], lines_[middle_j], 64);
    for (std::size_t i = middle_i; i-- > 0;) {
        fill(lines_[i], lines_[middle_j], lines_[i + 1], lines_[middle_j], careful);
    }
    for (std::size_t i = middle_i + 1; i < lines_.size(); ++i) {
        fill(lines_[i], lines_[middle_j], lines_[i - 1], lines_[middle_j], careful);
    }
    for (const std::size_t i : lines_) {
        for (std::size_t j = middle_j; j-- > 0;) fill(i, lines_[j], i, lines_[j + 1], careful);
        for (std::size_t j = middle_j + 1; j < lines_.size(); ++j) {
            fill(i, lines_[j], i, lines_[j - 1], careful);
        }
    }
}

std::vector<std::optional<Stability>> MapFiller::classes() {
    std::vector<std::optional<Stability>> result(places_.size());
    std::vector<Block> waiting;
    for (std::size_t j = 0; j + 1 < lines_.size(); ++j) {
        for (std::size_t i = 0; i + 1 < lines_.size(); ++i) {
            waiting.push_back({lines_[i], lines_[j], lines_[i + 1], lines_[j + 1]});
        }
    }
    while (!waiting.empty()) {
        const Block at = waiting.back();
        waiting.pop_back();
        if (is_uniform(at) || !at.is_divisible()) take_classes(at, result);
        else divide(at, waiting);
    }
    return result;
}

bool MapFiller::is_uniform(const Block& at) {
    const auto& first = place(at.left, at.low)->stability;
    return place(at.right, at.low)->stability == first &&
           place(at.left, at.high)->stability == first &&
           place(at.right, at.high)->stability == first;
}

/// Gives all unknown pairs of values in a block the class of its first corner.
void MapFiller::take_classes(const Block& at, std::vector<std::optional<Stability>>& classes) {
    const auto& first = place(at.left, at.low)->stability;
    for (std::size_t j = at.low; j <= at.high; ++j) {
        for (std::size_t i = at.left; i <= at.right; ++i) {
            const auto& known = place(i, j);
            classes[j * side_ + i] = known ? known->stability : first;
        }
    }
}

/// Finds the state at (i, j), beginning at a corner of the block that has a state.
void MapFiller::fill_from_corner(const Block& at, std::size_t i, std::size_t j) {
    for (const std::size_t row : {at.low, at.high}) {
        for (const std::size_t column : {at.left, at.right}) {
            if (place(column, row)->state) return fill(i, j, column, row, 1);
        }
    }
    fill(i, j, at.left, at.low, 1);
}

void MapFiller::divide(const Block& at, std::vector<Block>& waiting) {
    const std::size_t i = (at.left + at.right) / 2, j = (at.low + at.high) / 2;
    for (const std::size_t y : {at.low, j, at.high}) {
        for (const std::size_t x : {at.left, i, at.right}) fill_from_corner(at, x, y);
    }
    const auto push = [&](const Block& part) {
        if (part.right > part.left || part.high > part.low) waiting.push_back(part);
    };
    const bool splits_across = i > at.left, splits_up = j > at.low;
    push({at.left, at.low, splits_across ? i : at.right, splits_up ? j : at.high});
    if (splits_across) push({i, at.low, at.right, splits_up ? j : at.high});
    if (splits_up) push({at.left, j, splits_across ? i : at.right, at.high});
    if (splits_across && splits_up) push({i, j, at.right, at.high});
}

}  // namespace

Result<ParameterMap> map_parameters(const Program& program, std::uint32_t stage,
                                    const ParameterSpan& across, const ParameterSpan& up,
                                    std::size_t side, const Vector& state) {
    const std::array items{across.item, up.item};
    const auto model = linear_model(program, stage, items);
    if (!model) return tl::unexpected(model.error());
    std::vector<double> present;
    for (const ItemId item : items) {
        const auto value = present_value(program, stage, item);
        if (!value) return tl::unexpected(value.error());
        present.push_back(*value);
    }
    Follower follower(*model, present, state);
    MapFiller filler(follower, across, up, side);
    filler.follow_lines(present, state);
    return ParameterMap{across, up, side, filler.classes()};
}

}  // namespace cascade::analysis
