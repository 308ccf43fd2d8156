// A checked system: its quantities, definitions, rates and sides, and the settings that its stages
// take as defaults.
#pragma once

#include "core/side.h"
#include "ir/solver.h"
#include "ir/sweep_form.h"
#include "lang/program/formula.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace cascade {

/// The range of a parameter, written `in low .. high step s`.
struct ParameterRange {
    double low = 0;
    double high = 1;
    std::optional<double> step;
};

/// A species or a parameter of a system.
struct Quantity {
    std::string name;  ///< A member of a family has a name such as `u[2]`.
    Span span;         ///< The place of its declaration.
    bool is_species = false;
    std::string doc;  ///< The text of its doc comment; may be empty.
    std::optional<ParameterRange> range;
    Formula start;  ///< The default value. An ItemId in it is an item of the stage that uses the
                    ///< system.
};

struct Definition {
    std::string name;
    Span span;
    Formula formula;
};

struct Invariant {
    ItemId species;
    bool at_least = true;  ///< Whether the bound is the smallest value of the species. If false,
                           ///< it is the largest.
    Formula bound;         ///< A formula of numbers and parameters.
};

/// Settings of time. A system may set them as defaults, and a stage may replace these.
struct TimeSettings {
    std::optional<Solver> solver;
    Span solver_span;  ///< The place of the solver in the script.
    std::optional<double> tolerance;
    std::optional<double> duration;
    std::optional<bool> automatic_speed;  ///< `speed: auto`; false if `speed` is an expression.
    std::optional<Formula> until;         ///< The condition of `until`.
    std::optional<double> steady;         ///< The number of `until: steady(…)`.
    std::optional<std::int64_t> check;
    std::optional<double> every;
    Span every_span;
    std::optional<double> largest_step;
    Span largest_step_span;
    std::optional<std::int64_t> coarse;  ///< `start: coarse(…)`.
    Span coarse_span;
};

/// Settings that a system may set as defaults and a stage may replace.
struct Settings {
    std::optional<std::int64_t> iterations;
    std::optional<std::int64_t> interval;
    std::optional<Formula> frozen;
    std::optional<Formula> speed;
    std::optional<Formula> show;  ///< The default formula for pictures of a stage.
    /// The species that growth does not dilute.
    std::optional<std::vector<ItemId>> undiluted;
    TimeSettings time;
};

/// An index of a system's families, written `i: 1..3`.
struct Index {
    std::string name;
    Span span;
    std::int64_t low = 1;
    std::int64_t high = 1;
};

/// The rule at a side for a species.
struct SideSetting {
    SideKind kind = SideKind::no_flux;
    Formula value;  ///< For fixed, slope and flux. An ItemId is an item of the stage.
    Span span;      ///< The place of the rule in the script. Empty for a rule of the domain.
};

using SideSettings = std::array<SideSetting, wall_count>;

/// A definition that has rules at sides, with these rules. At sides without a rule the definition
/// is mirrored.
struct DefinitionSides {
    DefinitionId definition;
    SideSettings sides;
};

/// The subject of a rule at a side: a species or a definition.
using SideSubject = std::variant<ItemId, DefinitionId>;

struct SubjectSide {
    SideSubject subject;
    Side side = Side::left;
    SideSetting setting;
};

/// The parts that only systems of cells that crawl have (spec/cells.md). The formulas read no
/// definitions.
struct CellRules {
    ItemId place;  ///< The item of the first of the three components.
    ItemId frame;  ///< The item of the first of the four components w, x, y, z of a quaternion.
    ItemId radius, age;
    DefinitionId velocity, spin;  ///< Vectors: the sums of the terms of p' and of turn'.
    Formula divide, die;          ///< Conditions, as numbers. If empty, cells never divide or die.
    Formula along;   ///< The direction of a division, a vector. If empty, a random direction
                     ///< perpendicular to the normal.
    Formula ey, ez;  ///< Axes at the start, as vectors. If one is empty, starting_frame() chooses
                     ///< it.
    IdVector<ItemId, Formula> restarts;  ///< For each item, its value after a division. If empty,
                                         ///< both cells inherit the value.
    double reach = 1.2;         ///< Cells touch up to this multiple of the sum of their radii.
    std::vector<Formula> near;  ///< The distances of `over near(d)`, the same for all cells.

    /// Whether the item is a component of the position or of the frame. Scripts cannot name these
    /// components.
    bool has_component(ItemId item) const {
        const auto is_of = [&](ItemId first, std::size_t count) {
            return item.index() >= first.index() && item.index() < first.index() + count;
        };
        return is_of(place, 3) || is_of(frame, 4);
    }
};

/// The formulas of divide, die, along, of values that restart after a division, and of the
/// distances of `near`. Some of these formulas may be empty.
std::vector<const Formula*> rules_of(const CellRules& cells);

struct System {
    std::string name;
    Span span;
    bool built_in = false;
    std::optional<SystemId> base;                    ///< The system from which it is derived.
    std::vector<SystemId> joined;                    ///< For cells: the bases after the first.
    std::string doc;                                 ///< The text of its doc comment; may be empty.
    std::string title, cite, about;                  ///< Texts for readers; may be empty.
    std::vector<Index> indices;                      ///< Families become quantities u[1], u[2], …
    IdVector<ItemId, Quantity> quantities;           ///< In order of writing.
    IdVector<DefinitionId, Definition> definitions;  ///< Each comes after the definitions that it
                                                     ///< reads.
    IdVector<ItemId, Formula> rates;  ///< For each quantity. Parameters have a formula without
                                      ///< nodes.
    std::vector<ItemId> rate_order;   ///< The species. Each comes after the species whose rates its
                                      ///< own rate reads.
    std::vector<Invariant> invariants;
    std::vector<SubjectSide> sides;  ///< A later rule replaces an earlier rule for the same side
                                     ///< and subject.
    Settings settings;
    std::optional<CellRules> cells;  ///< For a `cells` block.

    // The items of a stage are its system's quantities, then `frozen`, then `speed`.
    ItemId frozen_item() const { return quantities.next(); }
    ItemId speed_item() const { return ItemId(quantities.size() + 1); }
    std::size_t item_count() const { return quantities.size() + 2; }
    auto items() const { return ids_below<ItemId>(item_count()); }
    std::string_view item_name(ItemId item) const;
    /// The name that enters the hash for random numbers of a starting value. All items of a frame
    /// have the same name.
    std::string_view draw_name(ItemId item) const;
    bool is_species(ItemId item) const {
        return item < quantities.next() && quantities[item].is_species;
    }
    /// The species, in the order of their items.
    IdVector<SpeciesId, ItemId> species() const;
    std::optional<SpeciesId> species_of(ItemId item) const;
    /// Whether each species has a rate and each definition a formula. After errors some may be
    /// missing.
    bool is_complete() const;
    std::uint32_t species_count() const { return static_cast<std::uint32_t>(species().size()); }
};

}  // namespace cascade
