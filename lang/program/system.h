// A checked system: quantities, definitions, rates, sides, and the settings that it gives its
// stages.
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

/// The range of a parameter, `in low .. high step s`.
struct ParameterRange {
    double low = 0;
    double high = 1;
    std::optional<double> step;
};

/// A species or a parameter of a system.
struct Quantity {
    std::string name;  ///< For a member of a family: `u[2]`.
    Span span;         ///< Where it was declared.
    bool is_species = false;
    std::string doc;  ///< The text of its doc comment; may be empty.
    std::optional<ParameterRange> range;
    Formula start;  ///< Default value; its `own` nodes are items of the stage that uses it.
};

struct Definition {
    std::string name;
    Span span;
    Formula formula;
};

struct Invariant {
    ItemId species;
    bool at_least = true;  ///< species >= bound, else species <= bound.
    Formula bound;         ///< Of numbers and parameters.
};

/// Settings of time that a system may give as defaults and a stage may replace.
struct TimeSettings {
    std::optional<Solver> solver;
    Span solver_span;  ///< Where it was written.
    std::optional<double> tolerance;
    std::optional<double> duration;
    std::optional<bool> automatic_speed;  ///< `speed: auto`; false where `speed` is an expression.
    std::optional<Formula> until;         ///< Either a condition …
    std::optional<double> steady;         ///< … or `steady(…)`.
    std::optional<std::int64_t> check;
    std::optional<double> largest_step;
    Span largest_step_span;
    std::optional<std::int64_t> coarse;  ///< `start: coarse(…)`.
    Span coarse_span;
};

/// Settings that a system may give as defaults and a stage may replace.
struct Settings {
    std::optional<std::int64_t> iterations;
    std::optional<std::int64_t> interval;
    std::optional<Formula> frozen;
    std::optional<Formula> speed;
    std::optional<Formula> show;  ///< The default formula for pictures of a stage.
    TimeSettings time;
};

/// An index of a system's families, `i: 1..3`.
struct Index {
    std::string name;
    Span span;
    std::int64_t low = 1;
    std::int64_t high = 1;
};

/// The rule of a species at a side.
struct SideSetting {
    SideKind kind = SideKind::no_flux;
    Formula value;  ///< Of fixed, slope and flux; its items are those of the stage.
    Span span;      ///< Where it was written; empty if it comes from the boundary.
};

using SideSettings = std::array<SideSetting, wall_count>;

/// The rules of a definition that has some. At the other sides it is mirrored.
struct DefinitionSides {
    DefinitionId definition;
    SideSettings sides;
};

/// What a rule at a side is about: a species or a definition.
using SideSubject = std::variant<ItemId, DefinitionId>;

struct SubjectSide {
    SideSubject subject;
    Side side = Side::left;
    SideSetting setting;
};

/// What makes a system one of cells that crawl (spec/cells.md). Its formulas read no definitions.
struct CellRules {
    ItemId place;  ///< The first of three components.
    ItemId frame;  ///< The first of four, of a quaternion w, x, y, z.
    ItemId radius, age;
    DefinitionId velocity, spin;  ///< The sums of the terms of p' and of turn', vectors.
    Formula divide, die;          ///< Conditions, numbers; empty: never.
    Formula along;                ///< A vector; empty: a random direction across the normal.
    Formula ey, ez;               ///< Axes at the start, vectors; empty: see starting_frame().
    IdVector<ItemId, Formula> restarts;  ///< Values after a division; empty: inherited.
    double reach = 1.2;         ///< Cells touch at up to this multiple of the sum of their radii.
    std::vector<Formula> near;  ///< The distances of `over near(d)`: the same for all cells.

    /// Is it a component of the place or of the frame, which no script can name?
    bool has_component(ItemId item) const {
        const auto is_of = [&](ItemId first, std::size_t count) {
            return item.index() >= first.index() && item.index() < first.index() + count;
        };
        return is_of(place, 3) || is_of(frame, 4);
    }
};

/// The formulas of divide, die, along, of values that start again, and of the distances of `near`.
/// Some may be empty.
std::vector<const Formula*> rules_of(const CellRules& cells);

struct System {
    std::string name;
    Span span;
    bool built_in = false;
    std::optional<SystemId> base;                    ///< The system from which it is derived.
    std::vector<SystemId> joined;                    ///< Of cells: the bases after the first.
    std::string doc;                                 ///< The text of its doc comment; may be empty.
    std::string title, cite, about;                  ///< Its texts; may be empty.
    std::vector<Index> indices;                      ///< Families become quantities u[1], u[2], …
    IdVector<ItemId, Quantity> quantities;           ///< In order of writing.
    IdVector<DefinitionId, Definition> definitions;  ///< Each after those it reads.
    IdVector<ItemId, Formula> rates;  ///< One per quantity; empty nodes for parameters.
    std::vector<ItemId> rate_order;   ///< Species, each after those whose rate it reads.
    std::vector<Invariant> invariants;
    std::vector<SubjectSide> sides;  ///< Later ones replace earlier ones.
    Settings settings;
    std::optional<CellRules> cells;  ///< Of a `cells` block.

    // A stage's items are its quantities, then `frozen`, then `speed`.
    ItemId frozen_item() const { return quantities.next(); }
    ItemId speed_item() const { return ItemId(quantities.size() + 1); }
    std::size_t item_count() const { return quantities.size() + 2; }
    auto items() const { return ids_below<ItemId>(item_count()); }
    std::string_view item_name(ItemId item) const;
    /// The name by which random numbers of a starting value are drawn: one for the whole frame.
    std::string_view draw_name(ItemId item) const;
    bool is_species(ItemId item) const {
        return item < quantities.next() && quantities[item].is_species;
    }
    /// In the order of their items.
    IdVector<SpeciesId, ItemId> species() const;
    std::optional<SpeciesId> species_of(ItemId item) const;
    /// Whether each species has a rate and each definition a formula. Errors may leave them empty.
    bool is_complete() const;
    std::uint32_t species_count() const { return static_cast<std::uint32_t>(species().size()); }
};

}  // namespace cascade
