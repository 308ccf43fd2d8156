// Derivatives of rates by forward accumulation, one species at a time, over a list of parts that
// definitions and rates share.
#include "lang/calculus/derivative.h"

#include "core/check.h"
#include "lang/calculus/slopes.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace cascade {

namespace {

/// The slopes by a species of all parts of the rates. Empty if there is no rule for a part that a
/// rate needs, or if there are too many slopes.
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

/// The bounds of one row or column of the matrix of slopes: of a rate by every species, or of every
/// rate by one species.
class LineBound {
public:
    explicit LineBound(Algebra& algebra)
        : algebra_(algebra),
          zero_(algebra.number(0)),
          whole_(zero_),
          far_(zero_),
          others_(zero_),
          own_(zero_) {}

    void add(const Slope& slope, bool is_own_species) {
        const NodeId size = algebra_.magnitude(slope.own);
        whole_ = algebra_.sum(whole_, algebra_.sum(size, slope.far));
        far_ = algebra_.sum(far_, slope.far);
        others_ = algebra_.sum(others_, slope.other);
        if (is_own_species) {
            own_ = slope.own;
        } else {
            others_ = algebra_.sum(others_, size);
        }
        if (slope.diffusion.empty()) return;
        (is_own_species ? own_diffusion_ : cross_diffusion_).push_back(slope.diffusion);
    }

    NodeId whole() const { return whole_; }
    NodeId far() const { return far_; }
    NodeId own() const { return own_; }
    /// Without growth of waves.
    NodeId at_rest() { return algebra_.sum(algebra_.magnitude(own_), others_); }
    bool has_cross_diffusion() const { return !cross_diffusion_.empty(); }

    /// The largest growth of waves of any length, or the reaction alone.
    NodeId reaction() {
        NodeId most = algebra_.magnitude(own_);
        for (const double x : lengths()) most = algebra_.maximum(most, growth(x));
        return algebra_.sum(most, others_);
    }

private:
    /// The values of x, relative to the largest gain, at which the growth of waves is evaluated.
    /// Growth that is linear in x is largest at an end; for nested operators it may be largest in
    /// between. Steps of √2 miss 4 % of a parabola at most.
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

    NodeId growth(double x) {
        NodeId sum = own_;
        for (const auto& each : own_diffusion_) sum = algebra_.sum(sum, factor(each, x));
        for (const auto& each : cross_diffusion_) {
            sum = algebra_.sum(sum, algebra_.magnitude(factor(each, x)));
        }
        return sum;
    }

    /// Σ coefficients[k] (−x)^(k+1), by Horner's scheme.
    NodeId factor(const std::vector<NodeId>& coefficients, double x) {
        const NodeId minus_x = algebra_.number(-x);
        NodeId sum = zero_;
        for (std::size_t k = coefficients.size(); k-- > 0;) {
            sum = algebra_.product(minus_x, algebra_.sum(coefficients[k], sum));
        }
        return sum;
    }

    Algebra& algebra_;
    NodeId zero_, whole_, far_, others_, own_;
    std::vector<std::vector<NodeId>> own_diffusion_, cross_diffusion_;
};

NodeId largest(Algebra& algebra, const std::vector<NodeId>& parts) {
    NodeId most = parts[0];
    for (const NodeId part : parts) most = algebra.maximum(most, part);
    return most;
}

/// The largest value of a part over the domain.
Formula over_domain(Algebra& algebra, NodeId part) {
    return algebra.formula(algebra.is_number(part) ? part
                                                   : algebra.call(Function::domain_max, {part}));
}

/// The matrix of slopes by rate and species, as rows and columns.
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

    NodeId whole() {
        std::vector<NodeId> parts;
        for (LineBound& row : rows_) parts.push_back(row.whole());
        return largest(algebra_, parts);
    }

    NodeId spread() {
        std::vector<NodeId> parts;
        for (LineBound& row : rows_) parts.push_back(row.far());
        return largest(algebra_, parts);
    }

    NodeId growth() {
        std::vector<NodeId> parts{algebra_.number(0)};
        for (LineBound& row : rows_) parts.push_back(row.own());
        return largest(algebra_, parts);
    }

    /// A matrix has the eigenvalues of its transpose. If one species drags another along, as bait
    /// does cells, its column may give a smaller bound than the other's row.
    NodeId reaction() {
        const NodeId by_rows = growth_in(rows_);
        const auto crosses = [](const LineBound& row) { return row.has_cross_diffusion(); };
        if (std::none_of(rows_.begin(), rows_.end(), crosses)) return by_rows;
        std::vector<NodeId> parts{growth_in(columns_)};
        for (LineBound& row : rows_) parts.push_back(row.at_rest());
        return algebra_.call(Function::min, {by_rows, largest(algebra_, parts)});
    }

private:
    NodeId growth_in(IdVector<SpeciesId, LineBound>& lines) {
        std::vector<NodeId> parts;
        for (LineBound& line : lines) parts.push_back(line.reaction());
        return largest(algebra_, parts);
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
    const NodeId whole = matrix.whole(), reaction = matrix.reaction();
    const NodeId spread = matrix.spread(), growth = matrix.growth();
    if (algebra.size() > most_calculus_nodes) return std::nullopt;
    return JacobianBound{over_domain(algebra, whole), over_domain(algebra, reaction),
                         over_domain(algebra, spread), over_domain(algebra, growth),
                         matrix.jumps()};
}

}  // namespace cascade
