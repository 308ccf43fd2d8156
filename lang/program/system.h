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
    std::string name;  ///< The name. A member of a family has a name such as `u[2]`.
    Span span;         ///< Where the quantity is declared.
    bool is_species = false;
    std::string doc;  ///< The doc comment; may be empty.
    std::optional<ParameterRange> range;
    /// The default value. An ItemId in this formula is an item of the stage that uses the system.
    Formula start;
};

struct Definition {
    std::string name;
    Span span;
    Formula formula;
};

struct Invariant {
    ItemId species;
    /// Whether the bound is the species' smallest value. If false, the bound is the largest value.
    bool at_least = true;
    Formula bound;  ///< The bound, as a formula of numbers and parameters.
};

/// Settings of time. A system may set defaults, and a stage may replace them.
struct TimeSettings {
    std::optional<Solver> solver;
    Span solver_span;  ///< Where the solver is in the script.
    std::optional<double> tolerance;
    std::optional<double> duration;
    /// True for `speed: auto`. False if `speed` is an expression.
    std::optional<bool> automatic_speed;
    std::optional<Formula> until;  ///< The condition in `until`.
    std::optional<double> steady;  ///< The number in `until: steady(…)`.
    std::optional<std::int64_t> check;
    std::optional<double> every;
    Span every_span;
    std::optional<double> largest_step;
    Span largest_step_span;
    std::optional<std::int64_t> coarse;  ///< The number in `start: coarse(…)`.
    Span coarse_span;
};

/// Settings for which a system may set defaults that a stage may replace.
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

/// The rule for a species at one side.
struct SideSetting {
    SideKind kind = SideKind::no_flux;
    /// The value for the kinds fixed, slope and flux. An ItemId in it is an item of the stage.
    Formula value;
    Span span;  ///< Where the rule is in the script. Empty for a rule of the domain.
};

using SideSettings = std::array<SideSetting, wall_count>;

/// The rules at sides of a definition. At sides without a rule the definition is mirrored.
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

/// The parts that only systems of crawling cells have (spec/cells.md). The formulas read no
/// definitions.
struct CellRules {
    ItemId place;  ///< The first of the three components of the position.
    ItemId frame;  ///< The first of the four components w, x, y, z of the frame, a quaternion.
    ItemId radius, age;
    DefinitionId velocity, spin;  ///< The sums of the terms of p' and of turn', as vectors.
    /// Conditions that are true if they are not 0. If empty, cells never divide or never die.
    Formula divide, die;
    /// The direction of a division, as a vector. If empty, the direction is random and
    /// perpendicular to the normal.
    Formula along;
    /// The axes of the frame at the start, as vectors. An empty axis is chosen by starting_frame().
    Formula ey, ez;
    /// For each item, its value after a division. If a formula is empty, both new cells inherit the
    /// value.
    IdVector<ItemId, Formula> restarts;
    /// Two cells touch if their distance is at most this number times the sum of their radii.
    double reach = 1.2;
    /// The distances d of `over near(d)`, which are the same for all cells.
    std::vector<Formula> near;

    /// Whether the item is a component of the position or of the frame. Scripts cannot name these
    /// components.
    bool has_component(ItemId item) const {
        const auto is_of = [&](ItemId first, std::size_t count) {
            return item.index() >= first.index() && item.index() < first.index() + count;
        };
        return is_of(place, 3) || is_of(frame, 4);
    }
};

/// The formulas of divide, die and along, of values that restart after a division, and of the
/// distances of `near`. Some of these formulas may be empty.
std::vector<const Formula*> rules_of(const CellRules& cells);

struct System {
    std::string name;
    Span span;
    bool built_in = false;
    std::optional<SystemId> base;    ///< The system from which this system is derived.
    std::vector<SystemId> joined;    ///< The bases after the first base; only for crawling cells.
    std::string doc;                 ///< The doc comment; may be empty.
    std::string title, cite, about;  ///< Texts for readers; may be empty.
    std::vector<Index> indices;      ///< The indices. A family becomes quantities u[1], u[2], …
    IdVector<ItemId, Quantity> quantities;  ///< In the order of the script.
    /// Each definition comes after the definitions that it reads.
    IdVector<DefinitionId, Definition> definitions;
    /// The rate of each quantity. For a parameter, the formula has no nodes.
    IdVector<ItemId, Formula> rates;
    /// The species. Each species comes after the species whose rates its own rate reads.
    std::vector<ItemId> rate_order;
    std::vector<Invariant> invariants;
    /// A later rule replaces an earlier rule for the same side and subject.
    std::vector<SubjectSide> sides;
    Settings settings;
    /// The rules for crawling cells, if the system is a `cells` block.
    std::optional<CellRules> cells;

    // The items of a stage are its system's quantities, then `frozen`, then `speed`.
    ItemId frozen_item() const { return quantities.next(); }
    ItemId speed_item() const { return ItemId(quantities.size() + 1); }
    std::size_t item_count() const { return quantities.size() + 2; }
    auto items() const { return ids_below<ItemId>(item_count()); }
    std::string_view item_name(ItemId item) const;
    /// The name on which the random numbers of an item's starting value depend. All items of a
    /// frame have the same name.
    std::string_view draw_name(ItemId item) const;
    bool is_species(ItemId item) const {
        return item < quantities.next() && quantities[item].is_species;
    }
    /// The species, in the order of their items.
    IdVector<SpeciesId, ItemId> species() const;
    std::optional<SpeciesId> species_of(ItemId item) const;
    /// Whether each species has a rate and each definition has a formula. Some may be missing after
    /// an error.
    bool is_complete() const;
    std::uint32_t species_count() const { return static_cast<std::uint32_t>(species().size()); }
};

}  // namespace cascade
