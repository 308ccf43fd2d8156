// Puts the rates and the values of sides into expressions, and assembles the Jacobian.
#include "continuation/steady_problem.h"

#include "continuation/decompositions.h"
#include "lang/calculus/side_values.h"
#include "lang/lower/lower_expressions.h"
#include "lang/program/calls.h"
#include "lang/program/nodes_of_rates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cascade::continuation {

namespace {

constexpr const char* no_steady_state = "so that no state is steady";

/// The parameters that depend on `varied`. Each parameter comes after the parameters that it reads.
Result<std::vector<ItemId>> followers_of(const Program& program, std::uint32_t stage,
                                         ItemId varied) {
    const System& system = program.system_of(stage);
    std::vector<ItemId> changing{varied};
    for (const ItemId item : program.stages[stage].order) {
        if (item == varied || system.is_species(item)) continue;
        const Formula& formula = program.stages[stage].items[item];
        const auto reads = [&](const Node& node) {
            const auto* read = node.as<ItemId>();
            return read != nullptr && std::ranges::find(changing, *read) != changing.end();
        };
        if (!holds_in(formula, reads)) continue;
        const bool reads_state =
            holds_in(formula, [&](const Node& node) { return is_species(system, node); });
        if (reads_state) {
            return failure(fmt::format("'{}' depends on the varied parameter and on a species",
                                       system.item_name(item)));
        }
        changing.push_back(item);
    }
    changing.erase(changing.begin());
    return changing;
}

/// Whether an item is this number in all cells.
bool is_number(const Stage& stage, ItemId item, double value) {
    const Formula& formula = stage.items[item];
    return formula.nodes.size() == 1 && formula.nodes.back().is(value);
}

}  // namespace

Result<void> check_steady(const Program& program, std::uint32_t stage) {
    const System& system = program.system_of(stage);
    const Stage& own = program.stages[stage];
    if (system.cells) return failure("its cells crawl, " + std::string(no_steady_state));
    if (system.species().empty()) return failure("it has no species");
    if (own.coarse != 1) return failure("its cells are wider than those of the domain");
    if (own.size) return failure("it has a size", "give it the parameters of that size instead");
    if (!own.definition_sides.empty()) {
        return failure("a definition in it has rules at sides, which are not supported");
    }
    if (!is_number(own, system.frozen_item(), 0)) {
        return failure("some of its cells are frozen, which is not supported");
    }
    if (!own.uniform[system.speed_item()]) return failure("its speed differs from cell to cell");
    const auto is_draw_in_rates = [](const Node& node) { return is_draw(node); };
    if (holds_in_rates(system, is_draw_in_rates)) {
        return failure("random numbers in its rates leave no state steady");
    }
    if (holds_in_rates(system, is_moment) || holds_in_sides(own, is_moment)) {
        return failure("its rates depend on time, " + std::string(no_steady_state));
    }
    const auto is_solved = [](const Node& node) { return solved_constraint(node).has_value(); };
    if (holds_in_rates(system, is_solved)) return failure("constraints are not supported");
    return {};
}

Result<SteadyProblem> SteadyProblem::create(const Program& program, std::uint32_t stage,
                                            const DomainCells& cells, ItemId varied,
                                            const ConstantValues& constants) {
    if (auto good = check_steady(program, stage); !good) return tl::unexpected(good.error());
    auto followers = followers_of(program, stage, varied);
    if (!followers) return tl::unexpected(followers.error());
    const System& system = program.system_of(stage);
    SteadyProblem problem;
    problem.grid_ = std::make_shared<PaddedGrid>(cells);
    problem.varied_ = varied;
    std::vector<ItemId> changing{varied};
    for (const ItemId item : system.species()) {
        problem.species_.push_back({item, {}, {}});
        changing.push_back(item);
    }
    lowering::PassContext context = lowering::context_of_steps(program, stage);
    context.is_step = false;  // No weights of links by tensors are computed for these expressions.
    const auto expressions_of = [&](const auto& add_roots) -> Result<FieldExpressions> {
        lowering::Expressions flat;
        Flattening flattening(flat.graph, FieldSpace::of(program, system));
        for (const ItemId item : *followers) {
            const Noise noise{std::string(system.draw_name(item)), false};
            flattening.set_item(item, flattening.add(program.stages[stage].items[item], noise));
        }
        add_roots(flat, flattening);
        flat.origins = flattening.origins();
        return FieldExpressions::create(lowering::lower_expressions(std::move(flat), context),
                                        context, *problem.grid_, changing, constants);
    };
    auto rates = expressions_of([&](lowering::Expressions& flat, Flattening& flattening) {
        flattening.add_rates(system);
        for (const Species& each : problem.species_) {
            flat.roots.push_back(flattening.rate(each.item));
        }
    });
    if (!rates) return tl::unexpected(rates.error());
    auto sides = expressions_of([&](lowering::Expressions& flat, Flattening& flattening) {
        problem.prepare_sides(flat, program, stage, flattening);
    });
    if (!sides) return tl::unexpected(sides.error());
    problem.rates_ = std::make_shared<FieldExpressions>(*std::move(rates));
    problem.sides_ = std::make_shared<FieldExpressions>(*std::move(sides));
    problem.find_areas(cells);
    problem.find_free_axes();
    problem.find_turns(cells);
    return problem;
}

/// Adds the values of sides as roots.
void SteadyProblem::prepare_sides(lowering::Expressions& sides, const Program& program,
                                  std::uint32_t stage, Flattening& flattening) {
    IdVector<SpeciesId, SideSettings> settings;
    if (!program.stages[stage].sides.empty()) settings = side_settings(program, stage);
    const SideRules usual(program.domain.grid.boundary);
    for (std::size_t s = 0; s < species_.size(); ++s) {
        lowering::SideKinds kinds{};
        std::map<int, std::size_t> values;
        for (std::size_t side = 0; side < side_count; ++side) {
            kinds[side] = usual.at[side].kind;
            if (settings.empty()) continue;
            const SideSetting& setting = settings[SpeciesId(s)][side];
            kinds[side] = setting.kind;
            if (!takes_value(setting.kind)) continue;
            values[static_cast<int>(side)] = sides.roots.size();
            sides.roots.push_back(flattening.add(setting.value));
        }
        extend(species_[s], static_cast<Index>(s), kinds, values);
    }
}

/// Writes the values of a species in the padded grid as sums of unknowns and values of sides.
void SteadyProblem::extend(Species& species, Index number, const lowering::SideKinds& kinds,
                           const std::map<int, std::size_t>& values) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        is_periodic_[axis] = is_periodic_[axis] && kinds[2 * axis] == SideKind::periodic;
    }
    using Row = std::map<Index, double>;
    std::vector<Row> inside(static_cast<std::size_t>(grid_->size()));
    std::map<int, std::vector<Row>> by_side;
    for (const auto& [side, root] : values) by_side[side].resize(inside.size());
    for (Index k = 0; k < cell_count(); ++k) {
        const Index cell = grid_->cells()[static_cast<std::size_t>(k)];
        inside[static_cast<std::size_t>(cell)][k * species_count() + number] = 1;
    }
    for (const PaddedGrid::HaloCell& halo : grid_->halo()) {
        const SideKind kind = kinds[static_cast<std::size_t>(halo.side)];
        const auto from =
            static_cast<std::size_t>(kind == SideKind::periodic ? halo.opposite : halo.inner);
        const double factor = kind == SideKind::fixed ? -1 : 1;
        const auto to = static_cast<std::size_t>(halo.cell);
        for (const auto& [unknown, weight] : inside[from]) inside[to][unknown] = factor * weight;
        for (auto& [side, rows] : by_side) {
            for (const auto& [cell, weight] : rows[from]) rows[to][cell] = factor * weight;
        }
        if (!takes_value(kind)) continue;
        by_side[halo.side][to][halo.beside] += kind == SideKind::fixed ? 2 : grid_->spacing();
    }
    const auto matrix_of = [](const std::vector<Row>& rows, Index columns) {
        std::vector<Eigen::Triplet<double>> entries;
        for (std::size_t row = 0; row < rows.size(); ++row) {
            for (const auto& [column, weight] : rows[row]) {
                entries.emplace_back(static_cast<Index>(row), column, weight);
            }
        }
        SparseRows matrix(static_cast<Index>(rows.size()), columns);
        matrix.setFromTriplets(entries.begin(), entries.end());
        return matrix;
    };
    species.inside = matrix_of(inside, size() + 1);
    for (const auto& [side, root] : values) {
        species.by_side.emplace_back(root, matrix_of(by_side[side], grid_->size()));
    }
}

ItemParts SteadyProblem::parts_at(const Vector& state, double parameter, bool with_slopes) {
    ItemParts parts;
    Vector unknowns(size() + 1);
    unknowns << state, parameter;
    Part& varied = parts[varied_];
    varied.values = Values::Constant(1, parameter);
    if (with_slopes) {
        varied.slopes = SparseRows(1, size() + 1);
        varied.slopes.insert(0, size()) = 1;
    }
    for (const Species& each : species_) {
        Part& part = parts[each.item];
        part.values = (each.inside * unknowns).array();
        if (with_slopes) part.slopes = each.inside;
    }
    if (sides_->root_count() == 0) return parts;
    const std::vector<Part> values = sides_->roots(parts, with_slopes);
    for (const Species& each : species_) {
        Part& part = parts[each.item];
        for (const auto& [root, effect] : each.by_side) {
            const Part& value = values[root];
            part.values += (effect * spread(value.values, grid_->size()).matrix()).array();
            if (value.is_constant()) continue;
            add_rows(part.slopes, effect * scaled(Values::Ones(grid_->size()), value.slopes));
        }
    }
    return parts;
}

Vector SteadyProblem::rates(const Vector& state, double parameter) {
    return assembled(rates_->roots(parts_at(state, parameter, false), false));
}

Vector SteadyProblem::assembled(const std::vector<Part>& roots) const {
    Vector rates(size());
    for (Index s = 0; s < species_count(); ++s) {
        const Part& root = roots[static_cast<std::size_t>(s)];
        for (Index k = 0; k < cell_count(); ++k) {
            const Index cell = grid_->cells()[static_cast<std::size_t>(k)];
            rates[k * species_count() + s] = root.values[root.is_uniform() ? 0 : cell];
        }
    }
    return rates;
}

Linearised SteadyProblem::linearised(const Vector& state, double parameter) {
    const std::vector<Part> roots = rates_->roots(parts_at(state, parameter, true), true);
    Linearised result{assembled(roots), SparseColumns(size(), size()), Vector::Zero(size())};
    std::vector<Eigen::Triplet<double>> entries;
    for (Index s = 0; s < species_count(); ++s) {
        const Part& root = roots[static_cast<std::size_t>(s)];
        if (root.is_constant()) continue;
        for (Index k = 0; k < cell_count(); ++k) {
            const Index row = k * species_count() + s;
            const Index cell = grid_->cells()[static_cast<std::size_t>(k)];
            for (SparseRows::InnerIterator entry(root.slopes, root.is_uniform() ? 0 : cell); entry;
                 ++entry) {
                if (entry.col() == size()) {
                    result.by_parameter[row] += entry.value();
                } else {
                    entries.emplace_back(row, entry.col(), entry.value());
                }
            }
        }
    }
    result.jacobian.setFromTriplets(entries.begin(), entries.end());
    return result;
}

Matrix SteadyProblem::conserved_near(const Vector& state, double parameter) {
    const double usual = 0.1 * state.cwiseAbs().maxCoeff();
    Vector other = state;
    for (Index k = 0; k < other.size(); ++k) {
        other[k] += (usual > 0 ? usual : 0.1) * (1.3 + std::sin(1.7 * static_cast<double>(k)));
    }
    const Linearised at = linearised(other, parameter);
    if (!at.rates.allFinite()) return Matrix(size(), 0);
    // Adds up each column over the rows of each species. If the total of a combination of species
    // does not change, its weights are orthogonal to all these sums.
    Matrix sums = Matrix::Zero(species_count(), size() + 1);
    for (Index column = 0; column < size(); ++column) {
        for (SparseColumns::InnerIterator entry(at.jacobian, column); entry; ++entry) {
            sums(entry.row() % species_count(), column) +=
                areas_[entry.row() / species_count()] * entry.value();
        }
    }
    double largest = 0;
    for (Index k = 0; k < at.jacobian.nonZeros(); ++k) {
        largest = std::max(largest, std::abs(at.jacobian.valuePtr()[k]));
    }
    for (Index row = 0; row < size(); ++row) {
        sums(row % species_count(), size()) += areas_[row / species_count()] * at.by_parameter[row];
    }
    const Matrix weights = across_rows(sums, 1e-9 * largest * std::sqrt(size()));
    Matrix totals(size(), weights.cols());
    for (Index row = 0; row < size(); ++row) {
        totals.row(row) = areas_[row / species_count()] * weights.row(row % species_count());
    }
    return totals;
}

}  // namespace cascade::continuation
