// Checks rules at the sides of stages. The rules depend on diffusion and on definitions, so systems
// must have been checked before.
#include "lang/check/blocks/check_side_values.h"

#include "lang/calculus/algebra.h"
#include "lang/calculus/side_values.h"
#include "lang/program/calls.h"
#include "lang/program/nodes_of_rates.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cascade::checking {

namespace {

class SideValues {
public:
    SideValues(const Program& program, Diagnostics& diagnostics)
        : program_(program), diagnostics_(diagnostics) {}

    void check(std::uint32_t stage) {
        stage_ = stage;
        diffusion_.clear();
        const auto& sides = program_.stages[stage].sides;
        bool is_sound = true;
        for (const SpeciesId species : sides.ids()) {
            for (std::size_t side = 0; side < wall_count; ++side) {
                if (takes_value(sides[species][side].kind))
                    is_sound = check_value(species, static_cast<Side>(side)) && is_sound;
            }
        }
        for (const DefinitionSides& each : program_.stages[stage].definition_sides) {
            is_sound = check_definition(each) && is_sound;
        }
        if (is_sound && program_.domain.stencil == StencilKind::fourth) check_reach();
        if (is_sound) check_solver();
    }

private:
    const System& system() const { return program_.system_of(stage_); }
    std::string_view name(SpeciesId species) const {
        return system().item_name(system().species()[species]);
    }
    std::string side_name(SpeciesId species, Side side) const {
        return fmt::format("{}.{}", name(species), side_names[static_cast<std::size_t>(side)]);
    }

    /// Reports an error. If the rule applies to many stages, because it belongs to a system or to
    /// the domain, the error is reported only once.
    bool report(Span span, std::string message, std::string hint) {
        if (std::ranges::find(reported_, span) == reported_.end()) {
            reported_.push_back(span);
            diagnostics_.error(span, std::move(message), std::move(hint));
        }
        return false;
    }

    bool check_value(SpeciesId species, Side side) {
        const SideSetting& setting =
            program_.stages[stage_].sides[species][static_cast<std::size_t>(side)];
        return check_definitions(setting) && check_draws(setting) &&
               (side != Side::border || check_border(setting)) &&
               check_flux(species, side, setting) && check_coupling(species, side, setting);
    }

    bool check_definitions(const SideSetting& setting) {
        for (const Node& node : setting.value.nodes) {
            const auto* id = node.as<DefinitionId>();
            if (id == nullptr) continue;
            const Definition& definition = system().definitions[*id];
            const Formula whole = without_definitions(system(), definition.formula);
            const Node* beyond = beyond_reach_of_side(system(), whole);
            if (beyond == nullptr && !holds_in(whole, is_draw)) continue;
            return report(node.span,
                          fmt::format("'{}' has no value at a side, because it contains {}",
                                      definition.name,
                                      beyond == nullptr ? std::string_view("random numbers")
                                                        : info(beyond->function).spelling),
                          "a side can read the cells beside it, but not their neighbours");
        }
        return true;
    }

    bool differs_by_cell(const Formula& formula) const {
        IdVector<NodeId, bool> differs;
        for (const Node& node : formula.nodes) {
            const bool is_read = std::ranges::any_of(node.reads(), [&](NodeId operand) {
                return bool{differs[operand]};
            });
            differs.push_back(cascade::differs_by_cell(node, is_read, program_, stage_));
        }
        return differs[NodeId(formula.nodes.size() - 1)];
    }

    /// Checks a definition that has rules at sides. The definition is stored in a plane, whose halo
    /// is filled only by these rules.
    bool check_definition(const DefinitionSides& sides) {
        const Definition& definition = system().definitions[sides.definition];
        const Formula whole = without_definitions(system(), definition.formula);
        for (const SideSetting& setting : sides.sides) {
            if (setting.span.end == 0) continue;
            const Node& root = whole.nodes.back();
            if (!root.is<Call>() || reads_file(root.function)) {
                return report(setting.span,
                              fmt::format("'{}' cannot have a side, because it is only another "
                                          "name",
                                          definition.name),
                              is_species(system(), root)
                                  ? fmt::format("write the side for {}",
                                                system().item_name(*root.as<ItemId>()))
                                  : "");
            }
            if (!differs_by_cell(whole)) {
                return report(setting.span,
                              fmt::format("'{}' is the same in all cells, so its side would "
                                          "never be read",
                                          definition.name),
                              "");
            }
            // A field that a constraint determines is always read, because the constraint reads it.
            if (!solved_constraint(root) && !is_read_beside(system(), sides.definition)) {
                return report(setting.span,
                              fmt::format("the side of '{0}' has no effect, because no operator "
                                          "reads '{0}'",
                                          definition.name),
                              "");
            }
            if (&setting == &sides.sides.back() && !check_border(setting)) return false;
            if (!takes_value(setting.kind)) continue;
            const Formula value = without_definitions(system(), setting.value);
            const auto read = std::ranges::find_if(value.nodes, [&](const Node& node) {
                return is_species(system(), node);
            });
            if (read != value.nodes.end()) {
                return report(setting.span,
                              fmt::format("a side of a definition cannot read '{}'",
                                          system().item_name(*read->as<ItemId>())),
                              "it can read parameters, t and step; only the side of a species "
                              "can read species");
            }
        }
        return true;
    }

    /// Reports a nested difference if it is mirrored at a side where a species that it reads is not
    /// mirrored.
    void check_reach() {
        const auto check = [&](const SideSettings& sides) {
            for (const SideSetting& setting : sides) {
                if (!takes_value(setting.kind)) continue;
                report(setting.span, "with stencil: fourth, sides must be periodic or noflux",
                       "write stencil: isotropic or stencil: cross for sides with values, slopes "
                       "or fluxes");
            }
        };
        for (const SideSettings& sides : program_.stages[stage_].sides) check(sides);
        for (const DefinitionSides& each : program_.stages[stage_].definition_sides)
            check(each.sides);
    }

    bool check_draws(const SideSetting& setting) {
        const auto draw = std::ranges::find_if(setting.value.nodes, is_draw);
        if (draw == setting.value.nodes.end()) return true;
        const bool changes =
            holds_in(setting.value, [&](const Node& node) { return is_species(system(), node); });
        if (!changes) return true;
        return report(draw->span, "a side that reads species cannot draw random numbers",
                      "draw them in a parameter, as in name: random(…), and read the parameter");
    }

    /// Checks a rule at the border of a mask. The value of the rule is computed together with the
    /// rates, so the rule may read only values in cells.
    bool check_border(const SideSetting& setting) {
        if (!takes_value(setting.kind)) return true;
        const auto& surface = program_.domain.surface;
        if (surface && surface->has_metric && setting.kind != SideKind::fixed) {
            return report(setting.span, "on a surface a border must be noflux or fixed(…)",
                          "slope(…) and flux(…) work only with square cells");
        }
        const Formula whole = without_definitions(system(), setting.value);
        const auto found = std::ranges::find_if(whole.nodes, [](const Node& node) {
            return node.is<Call>() && varies_by_cell(node.function) &&
                   info(node.function).kind != FunctionKind::shape && !reads_file(node.function);
        });
        if (found == whole.nodes.end()) return true;
        return report(setting.span,
                      fmt::format("the value at a border cannot contain {}",
                                  info(found->function).spelling),
                      "compute it in a parameter, name: …, and read the parameter");
    }

    bool check_flux(SpeciesId species, Side side, const SideSetting& setting) {
        if (setting.kind != SideKind::flux) return true;
        if (diffusion_.empty()) diffusion_ = diffusion_of(program_, stage_);
        const Conductivity found = conductivity_at(system(), diffusion_, species, side);
        if (found.factor) return true;
        // A rule of the domain applies to all species, including species that never change.
        const auto& of_all = program_.domain.sides[static_cast<std::size_t>(side)];
        const bool is_of_all = of_all && of_all->span == setting.span;
        if (is_of_all && !is_read_beside(system(), system().species()[species])) return true;
        return report(setting.span,
                      fmt::format("the flux of {0} cannot be given, because {0} {1}", name(species),
                                  found.why_not),
                      "slope(…) works with every rate: it sets the derivative along the outward "
                      "normal");
    }

    bool check_coupling(SpeciesId species, Side side, const SideSetting& setting) {
        const std::size_t count = coupled_at_side(program_, stage_, species, side).size();
        if (count <= most_coupled_at_side) return true;
        return report(setting.span,
                      fmt::format("at {} {} species depend on each other, but at most {} may",
                                  side_name(species, side), count, most_coupled_at_side),
                      "");
    }

    void check_solver() {
        const StageTime& time = program_.stages[stage_].time;
        const bool is_in_turn = changes_in_turn(time.solver);
        if (!is_in_turn && !is_semi_implicit(time.solver)) return;
        for (const DefinitionSides& each : program_.stages[stage_].definition_sides) {
            const bool is_held = std::ranges::any_of(each.sides, [](const SideSetting& side) {
                return side.kind == SideKind::fixed;
            });
            if (is_in_turn || !is_held) continue;
            diagnostics_.error(
                time.solver_span,
                fmt::format(
                    "stage '{}': {} cannot hold the value of {} at a side, because this solver "
                    "can hold only species",
                    program_.stages[stage_].name, name_of(time.solver),
                    system().definitions[each.definition].name),
                "write solver: rkl2");
            return;
        }
        const auto settings = side_settings(program_, stage_);
        const auto species = system().species();
        for (const SpeciesId own : settings.ids()) {
            for (std::size_t side = 0; side < wall_count; ++side) {
                const auto reads = [&](const Node& node) {
                    return is_species(system(), node) && !(is_in_turn && node.is(species[own]));
                };
                if (!holds_in(settings[own][side].value, reads)) continue;
                const std::string what =
                    is_in_turn ? "steps one species after the other, so it cannot follow"
                               : "reads sides between steps only, so it cannot "
                                 "follow";
                diagnostics_.error(time.solver_span,
                                   fmt::format("stage '{}': {} {} {}, which reads species",
                                               program_.stages[stage_].name, name_of(time.solver),
                                               what, side_name(own, static_cast<Side>(side))),
                                   is_in_turn ? "write solver: rk4, which steps all species "
                                                "together"
                                              : "write solver: rkl2, which takes long steps, too");
                return;
            }
        }
    }

    const Program& program_;
    Diagnostics& diagnostics_;
    std::uint32_t stage_ = 0;
    /// The diffusion of the stage's species. Empty until it is needed.
    IdVector<SpeciesId, SpeciesDiffusion> diffusion_;
    std::vector<Span> reported_;
};

}  // namespace

void check_side_values(const Program& program, Diagnostics& diagnostics) {
    SideValues values(program, diagnostics);
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) values.check(k);
}

}  // namespace cascade::checking
