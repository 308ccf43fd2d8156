// Derivatives of rates, found by forward accumulation. For each species, one loop over all
// subexpressions of definitions and rates computes their derivatives. Equal subexpressions occur
// once in the loop.
#include "lang/calculus/derivative.h"

#include "core/check.h"
#include "lang/calculus/slopes.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace cascade {

namespace {

/// The slopes of all subexpressions of the rates with respect to a species. nullopt if there is no
/// rule for a subexpression that a rate needs, or if there are too many slopes.
std::optional<IdVector<NodeId, Slopes>> slopes_of(FlatRates& rates, SlopeRules& rules,
                                                  ItemId species) {
    IdVector<NodeId, Slopes> slopes;
    slopes.reserve(rates.count);
    for (const NodeId id : ids_below<NodeId>(rates.count)) {
        auto slope = rules.slopes_of(id, species, slopes);
        if (!slope || rates.algebra.size() > most_calculus_nodes) return std::nullopt;
        slopes.push_back(std::move(*slope));
    }
    return slopes;
}

/// Bounds for one row or column of the matrix of slopes. A row contains the slopes of one rate with
/// respect to all species. A column contains the slopes of all rates with respect to one species.
class LineBound {
public:
    explicit LineBound(Algebra& algebra)
        : zero_{&algebra, algebra.number(0)},
          whole_(zero_),
          far_(zero_),
          others_(zero_),
          own_(zero_) {}

    void add(const Slope& slope, bool is_own_species) {
        const Term size = abs(slope.own);
        whole_ = whole_ + (size + slope.far);
        far_ = far_ + slope.far;
        others_ = others_ + slope.other;
        if (is_own_species) {
            own_ = slope.own;
        } else {
            others_ = others_ + size;
        }
        if (slope.diffusion.empty()) return;
        (is_own_species ? own_diffusion_ : cross_diffusion_).push_back(slope.diffusion);
    }

    Term whole() const { return whole_; }
    Term far() const { return far_; }
    Term own() const { return own_; }
    /// The bound for the row or column if waves do not grow.
    Term at_rest() { return abs(own_) + others_; }
    bool has_cross_diffusion() const { return !cross_diffusion_.empty(); }

    /// The largest growth of a wave of any length. If the bound of the reaction alone is larger,
    /// this bound.
    Term reaction() {
        Term most = abs(own_);
        for (const double x : lengths()) most = max(most, growth(x));
        return most + others_;
    }

private:
    /// The values of x, relative to the largest gain, at which the growth of waves is evaluated.
    /// Growth that is linear in x is largest at one end of the range. With nested operators, growth
    /// may be largest inside the range. In this case adjacent values of x differ by a factor √2, so
    /// the maximum of a parabola is underestimated by at most 4 %.
    std::vector<double> lengths() const {
        std::size_t degree = 0;
        for (const auto* diffusions : {&own_diffusion_, &cross_diffusion_}) {
            for (const auto& each : *diffusions) degree = std::max(degree, each.size());
        }
        std::vector<double> lengths;
        const int count = degree == 0 ? 0 : degree == 1 ? 1 : 17;
        for (int n = 0; n < count; ++n) lengths.push_back(std::exp2(-0.5 * n));
        return lengths;
    }

    Term growth(double x) {
        Term sum = own_;
        for (const auto& each : own_diffusion_) sum = sum + factor(each, x);
        for (const auto& each : cross_diffusion_) {
            sum = sum + abs(factor(each, x));
        }
        return sum;
    }

    /// Σ coefficients[k] (−x)^(k+1), by Horner's scheme.
    Term factor(const std::vector<Term>& coefficients, double x) {
        const Term minus_x = zero_.number(-x);
        Term sum = zero_;
        for (std::size_t k = coefficients.size(); k-- > 0;) {
            sum = minus_x * (coefficients[k] + sum);
        }
        return sum;
    }

    Term zero_, whole_, far_, others_, own_;
    std::vector<std::vector<Term>> own_diffusion_, cross_diffusion_;
};

Term largest(const std::vector<Term>& parts) {
    Term most = parts[0];
    for (const Term part : parts) most = max(most, part);
    return most;
}

/// A formula for the largest value that `part` has in the domain.
Formula over_domain(const Algebra& algebra, Term part) {
    return algebra.formula(algebra.is_number(part) ? part : domain_max(part));
}

/// The matrix of slopes, by rows (rates) and columns (species).
class SlopeMatrix {
public:
    SlopeMatrix(Algebra& algebra, std::size_t species)
        : algebra_(algebra),
          rows_(species, LineBound(algebra)),
          columns_(species, LineBound(algebra)) {}

    void add(const Slope& slope, SpeciesId of, SpeciesId by) {
        rows_[of].add(slope, of == by);
        columns_[by].add(slope, of == by);
        jumps_ |= slope.jumps;
    }

    bool jumps() const { return jumps_; }

    Term whole() {
        std::vector<Term> parts;
        for (LineBound& row : rows_) parts.push_back(row.whole());
        return largest(parts);
    }

    Term spread() {
        std::vector<Term> parts;
        for (LineBound& row : rows_) parts.push_back(row.far());
        return largest(parts);
    }

    Term growth() {
        std::vector<Term> parts{{&algebra_, algebra_.number(0)}};
        for (LineBound& row : rows_) parts.push_back(row.own());
        return largest(parts);
    }

    /// A bound of the reaction. A matrix and its transpose have the same eigenvalues, so the bound
    /// from the columns is valid, too. It may be smaller than the bound from the rows: if one
    /// species drags another along, as bait drags cells, the column of the first species may have a
    /// smaller bound than the row of the second.
    Term reaction() {
        const Term by_rows = growth_in(rows_);
        const auto crosses = [](const LineBound& row) { return row.has_cross_diffusion(); };
        if (std::none_of(rows_.begin(), rows_.end(), crosses)) return by_rows;
        std::vector<Term> parts{growth_in(columns_)};
        for (LineBound& row : rows_) parts.push_back(row.at_rest());
        return min(by_rows, largest(parts));
    }

private:
    Term growth_in(IdVector<SpeciesId, LineBound>& lines) {
        std::vector<Term> parts;
        for (LineBound& line : lines) parts.push_back(line.reaction());
        return largest(parts);
    }

    Algebra& algebra_;
    IdVector<SpeciesId, LineBound> rows_, columns_;
    bool jumps_ = false;
};

}  // namespace

std::optional<LocalJacobian> local_jacobian(const Program& program, std::uint32_t stage) {
    const System& system = program.system_of(stage);
    FlatRates rates(system, FieldSpace::of(program, system));
    SlopeRules rules(rates.algebra, program, nullptr);
    const auto species = system.species();
    LocalJacobian jacobian;
    jacobian.rows.resize(species.size());
    for (const SpeciesId by : species.ids()) {
        const auto slopes = slopes_of(rates, rules, species[by]);
        if (!slopes) return std::nullopt;
        for (const SpeciesId of : species.ids()) {
            jacobian.rows[of].push_back((*slopes)[rates.rate(species[of])][0].own);
        }
    }
    jacobian.algebra = std::move(rates.algebra);
    return jacobian;
}

std::optional<JacobianBound> jacobian_bound(const Program& program, std::uint32_t stage,
                                            const ModelFacts* model) {
    CHECK(!program.domain.model || model, "a bound on a model depends on its cells");
    const System& system = program.system_of(stage);
    FlatRates rates(system, FieldSpace::of(program, system));
    Algebra& algebra = rates.algebra;
    SlopeRules rules(algebra, program, model);
    const auto species = system.species();
    SlopeMatrix matrix(algebra, species.size());
    for (const SpeciesId by : species.ids()) {
        const auto slopes = slopes_of(rates, rules, species[by]);
        if (!slopes) return std::nullopt;
        for (const SpeciesId of : species.ids()) {
            matrix.add((*slopes)[rates.rate(species[of])][0], of, by);
        }
    }
    const Term whole = matrix.whole(), reaction = matrix.reaction();
    const Term spread = matrix.spread(), growth = matrix.growth();
    if (algebra.size() > most_calculus_nodes) return std::nullopt;
    return JacobianBound{over_domain(algebra, whole), over_domain(algebra, reaction),
                         over_domain(algebra, spread), over_domain(algebra, growth),
                         matrix.jumps()};
}

}  // namespace cascade
