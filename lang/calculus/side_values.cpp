// Solves a small system of linear equations for each side, in which each species has one unknown.
// If the species' rule gives a slope, the unknown is the slope at the face. Otherwise it is the
// change of the species from the cell to the face. The equations are solved by elimination before
// the run, and the results are formulas.
#include "lang/calculus/side_values.h"

#include "core/check.h"
#include "lang/calculus/algebra.h"
#include "lang/calculus/derivative_rules.h"
#include "lang/program/calls.h"
#include "lang/program/nodes_of_rates.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace cascade {

namespace {

bool reads_definitions(const Formula& formula) {
    return holds_in(formula, [](const Node& node) { return node.is<DefinitionId>(); });
}

Formula flat(const System& system, const Formula& formula) {
    return reads_definitions(formula) ? without_definitions(system, formula) : formula;
}

/// The equations of one side.
class FaceEquations {
public:
    FaceEquations(const Program& program, std::uint32_t stage, Side side)
        : program_(program),
          stage_(stage),
          system_(program.system_of(stage)),
          side_(side),
          species_(system_.species()),
          rates_(system_, FieldSpace::of(program, system_)),
          algebra_(rates_.algebra),
          zero_(algebra_.number(0)),
          values_(species_.size()) {}

    /// The species whose values at the face determine the value of `of` there. `of` comes last.
    std::vector<SpeciesId> coupled(SpeciesId of) {
        std::vector<SpeciesId> found{of};
        for (std::size_t next = 0; next < found.size(); ++next) {
            for (const SpeciesId read : unknowns_in(found[next])) {
                if (std::find(found.begin(), found.end(), read) == found.end())
                    found.push_back(read);
            }
        }
        std::rotate(found.begin(), found.begin() + 1, found.end());
        return found;
    }

    /// The value of `of` at the face or, if the rule of `of` gives a slope, the slope there.
    Formula solve(SpeciesId of) {
        if (unknowns_in(of).empty()) return algebra_.formula(value(of));
        const std::vector<SpeciesId> unknown = coupled(of);
        const std::size_t count = unknown.size();
        CHECK(count <= most_coupled_at_side, "few species are coupled at a side");
        std::vector<std::vector<NodeId>> matrix(count);
        std::vector<NodeId> right;
        for (std::size_t row = 0; row < count; ++row) {
            for (std::size_t column = 0; column < count; ++column) {
                const NodeId by = algebra_.product(slope(value(unknown[row]), unknown[column]),
                                                   change_by(unknown[column]));
                matrix[row].push_back(algebra_.difference(algebra_.number(row == column), by));
            }
            right.push_back(is_fixed(unknown[row])
                                ? algebra_.difference(value(unknown[row]), cell(unknown[row]))
                                : value(unknown[row]));
        }
        for (std::size_t pivot = 0; pivot + 1 < count; ++pivot) {
            for (std::size_t row = pivot + 1; row < count; ++row) {
                const NodeId part = algebra_.quotient(matrix[row][pivot], matrix[pivot][pivot]);
                const auto subtract = [&](NodeId& from, NodeId what) {
                    from = algebra_.difference(from, algebra_.product(part, what));
                };
                for (std::size_t column = pivot + 1; column < count; ++column)
                    subtract(matrix[row][column], matrix[pivot][column]);
                subtract(right[row], right[pivot]);
            }
        }
        const NodeId found = algebra_.quotient(right.back(), matrix.back().back());
        return algebra_.formula(is_fixed(of) ? algebra_.sum(cell(of), found) : found);
    }

private:
    const SideSetting& setting(SpeciesId species) const {
        return program_.stages[stage_].sides[species][static_cast<std::size_t>(side_)];
    }
    bool is_fixed(SpeciesId species) const { return setting(species).kind == SideKind::fixed; }
    NodeId cell(SpeciesId species) { return algebra_.leaf(species_[species]); }

    /// The value or slope that a species' rule gives if it reads values in the cell in place of
    /// values at the face.
    NodeId value(SpeciesId species) {
        std::optional<NodeId>& known = values_[species];
        if (known) return *known;
        const SideSetting& rule = setting(species);
        NodeId node = rates_.flattening.add(rule.value);
        if (rule.kind == SideKind::flux) {
            if (diffusion_.empty()) diffusion_ = diffusion_of(program_, stage_, side_);
            const auto factor = conductivity_at(system_, diffusion_, species, side_).factor;
            // If no operator reads the species, its rule has no effect.
            node = factor ? algebra_.quotient(node, rates_.flattening.add(*factor)) : zero_;
        }
        known = node;
        return node;
    }

    /// The species that the rule of `species` reads and whose values differ between the cell and
    /// the face.
    std::vector<SpeciesId> unknowns_in(SpeciesId species) {
        std::vector<SpeciesId> found;
        const NodeId root = value(species);
        const IdVector<NodeId, bool> needed = needed_by(algebra_, {&root, 1});
        for (const NodeId id : ids_below<NodeId>(needed.size())) {
            if (!needed[id] || !is_species(system_, algebra_[id])) continue;
            const auto read = *system_.species_of(*algebra_[id].as<ItemId>());
            if (takes_value(setting(read).kind)) found.push_back(read);
        }
        return found;
    }

    /// The derivative of a value with respect to a species. Functions without a rule for
    /// derivatives contribute 0.
    NodeId slope(NodeId root, SpeciesId by) {
        const IdVector<NodeId, bool> needed = needed_by(algebra_, {&root, 1});
        IdVector<NodeId, NodeId> slopes(needed.size(), zero_);
        for (const NodeId id : ids_below<NodeId>(needed.size())) {
            if (!needed[id]) continue;
            const Node node = algebra_[id];
            if (node.is(species_[by])) slopes[id] = algebra_.number(1);
            for (std::size_t n = 0; n < node.operand_count; ++n) {
                const NodeId inner = slopes[node.operands[n]];
                if (inner == zero_) continue;
                const auto partial = partial_derivative(algebra_, node, n);
                if (!partial) continue;
                slopes[id] = algebra_.sum(slopes[id], algebra_.product(*partial, inner));
            }
        }
        return slopes[root];
    }

    /// The change of a species from the cell to the face, divided by the species' unknown. This is
    /// half a cell's width if the unknown is a slope, and 1 if the unknown is the change itself.
    NodeId change_by(SpeciesId species) {
        if (is_fixed(species)) return algebra_.number(1);
        const NodeId half = algebra_.number(program_.domain.grid.spacing / 2);
        const auto& surface = program_.domain.surface;
        if (!surface || !surface->has_metric) return half;
        // This is the same formula as in across_side() in lang/lower/surface_pass.cpp.
        const auto square = [&](MetricPlane plane) {
            return algebra_.product(algebra_.leaf(plane), algebra_.leaf(plane));
        };
        const bool is_column = side_ == Side::left || side_ == Side::right;
        const NodeId diagonal = is_column ? algebra_.sum(square(MetricPlane::inverse_11),
                                                         square(MetricPlane::inverse_12))
                                          : square(MetricPlane::inverse_22);
        return algebra_.quotient(half, algebra_.call(Function::sqrt, {diagonal}));
    }

    const Program& program_;
    std::uint32_t stage_;
    const System& system_;
    Side side_;
    IdVector<SpeciesId, ItemId> species_;
    FlatRates rates_;
    Algebra& algebra_;
    NodeId zero_;
    IdVector<SpeciesId, std::optional<NodeId>> values_;
    IdVector<SpeciesId, SpeciesDiffusion> diffusion_;  ///< Empty until it is needed.
};

/// For each node of a formula without definitions, whether its value may change during the stage.
IdVector<NodeId, bool> changing_nodes(const System& system, const Formula& formula) {
    IdVector<NodeId, bool> changes;
    for (const Node& node : formula.nodes) {
        bool is_changing = is_moment(node) || is_species(system, node);
        for (const NodeId operand : node.reads()) is_changing |= changes[operand];
        changes.push_back(is_changing);
    }
    return changes;
}

/// Replaces the rules at a side by rules that contain no fluxes, no definitions and no values at
/// the face.
void settle(IdVector<SpeciesId, SideSettings>& settings, const Program& program,
            std::uint32_t stage, Side side) {
    const System& system = program.system_of(stage);
    std::unique_ptr<FaceEquations> equations;
    for (const SpeciesId species : settings.ids()) {
        SideSetting& setting = settings[species][static_cast<std::size_t>(side)];
        if (!takes_value(setting.kind)) continue;
        const bool stays =
            setting.kind != SideKind::flux && !reads_definitions(setting.value) &&
            !holds_in(setting.value, [&](const Node& node) { return is_species(system, node); });
        if (stays) continue;
        if (!equations) equations = std::make_unique<FaceEquations>(program, stage, side);
        setting.value = equations->solve(species);
        if (setting.kind == SideKind::flux) setting.kind = SideKind::slope;
    }
}

}  // namespace

IdVector<SpeciesId, SideSettings> side_settings(const Program& program, std::uint32_t stage) {
    IdVector<SpeciesId, SideSettings> settings = program.stages[stage].sides;
    for (std::size_t side = 0; side < side_count; ++side)
        settle(settings, program, stage, static_cast<Side>(side));
    return settings;
}

IdVector<SpeciesId, SideSettings> border_settings(const Program& program, std::uint32_t stage) {
    IdVector<SpeciesId, SideSettings> settings = program.stages[stage].sides;
    settle(settings, program, stage, Side::border);
    return settings;
}

Conductivity conductivity_at(const System& system,
                             const IdVector<SpeciesId, SpeciesDiffusion>& diffusion_of_all,
                             SpeciesId species, Side side) {
    const ItemId item = system.species()[species];
    FlatRates rates(system);
    const NodeId rate = rates.rate(item);
    const IdVector<NodeId, bool> needed = needed_by(rates.algebra, {&rate, 1});
    for (const NodeId id : ids_below<NodeId>(needed.size())) {
        if (needed[id] && calls(rates.algebra[id], has_tensor))
            return {std::nullopt, "diffuses in a direction"};
    }
    const SpeciesDiffusion& diffusion = diffusion_of_all[species];
    const auto is_there = [](const Formula& factor) { return !factor.nodes.empty(); };
    const auto powers = diffusion.begin() + laplacian_powers;
    if (std::any_of(diffusion.begin() + 1, powers, is_there))
        return {std::nullopt, "has lap of lap in its rate"};
    if (side == Side::border && std::any_of(powers, diffusion.begin() + decay_term, is_there))
        return {std::nullopt, "diffuses along single axes"};
    std::vector<std::size_t> terms{0};
    if (side != Side::border)
        terms.push_back(laplacian_powers + static_cast<std::size_t>(side) / 2);
    std::vector<NodeId> parts;
    for (const std::size_t term : terms) {
        if (is_there(diffusion[term])) parts.push_back(rates.flattening.add(diffusion[term]));
    }
    if (parts.empty()) return {std::nullopt, "has no diffusion in its rate"};
    const NodeId sum = parts.size() == 1 ? parts[0] : rates.algebra.sum(parts[0], parts[1]);
    Formula factor = rates.algebra.formula(sum);
    if (beyond_reach_of_side(system, factor) != nullptr)
        return {std::nullopt, "has diffusion that depends on other cells"};
    return {std::move(factor), {}};
}

bool is_read_beside(const System& system, const SideSubject& subject) {
    const FlatRates rates(system);
    const auto* definition = std::get_if<DefinitionId>(&subject);
    const NodeId sought =
        definition != nullptr ? rates.flattening.definition(*definition) : NodeId();
    const auto is_sought = [&](NodeId id) {
        return definition != nullptr ? id == sought
                                     : rates.algebra[id].is(std::get<ItemId>(subject));
    };
    IdVector<NodeId, bool> depends;
    for (const NodeId id : ids_below<NodeId>(rates.count)) {
        const Node& node = rates.algebra[id];
        bool is_read = false;
        for (const NodeId operand : node.reads()) is_read |= depends[operand];
        if (is_read && node.is<Call>() &&
            (differentiates(node.function) || node.type == ValueType::vector)) {
            return true;
        }
        depends.push_back(is_read || is_sought(id));
    }
    return false;
}

bool changes_at_side(const System& system, const Formula& formula) {
    const Formula whole = flat(system, formula);
    return holds_in(whole,
                    [&](const Node& node) { return is_moment(node) || is_species(system, node); });
}

const Node* beyond_reach_of_side(const System& system, const Formula& formula) {
    const IdVector<NodeId, bool> changes = changing_nodes(system, formula);
    for (const NodeId id : changes.ids()) {
        const Node& node = formula.nodes[id];
        if (!changes[id] || !node.is<Call>() || node.calls(Function::vector)) continue;
        if (varies_by_cell(node.function) || info(node.function).is_aggregate) return &node;
    }
    return nullptr;
}

std::vector<SpeciesId> coupled_at_side(const Program& program, std::uint32_t stage, SpeciesId of,
                                       Side side) {
    return FaceEquations(program, stage, side).coupled(of);
}

}  // namespace cascade
