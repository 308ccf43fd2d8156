// The checked program: every name is resolved, every argument counted, every order known. It
// contains no user error, so later stages only CHECK.
#pragma once

#include "core/axis.h"
#include "core/grid.h"
#include "core/id.h"
#include "core/picture_channel.h"
#include "core/precision.h"
#include "core/side.h"
#include "core/source.h"
#include "ir/reduction.h"
#include "ir/solver.h"
#include "ir/sweep_form.h"
#include "lang/vocabulary/functions.h"

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace cascade {

/// What operators read of the surface, one plane each (surface/parameter_surface.h).
// clang-format off
enum class MetricPlane : std::uint8_t {
    inverse_11, inverse_12, inverse_22,  ///< Ṽ⁻¹.
    area,                                ///< s, the area of the cell.
    flow_11, flow_12, flow_22,           ///< s Ṽ⁻¹ Ṽ⁻ᵀ: turns differences into fluxes.
};
// clang-format on
inline constexpr std::size_t metric_plane_count = 7;
/// The name in dumps. No name of the language begins with a bracket.
inline constexpr std::array<std::string_view, metric_plane_count> metric_names{
    "(metric 11)", "(metric 12)", "(metric 22)", "(area)", "(flow 11)", "(flow 12)", "(flow 22)"};

/// What kernels read of the cells of a model, one plane each (run/domain/model_cells.h).
// clang-format off
enum class ModelPlane : std::uint8_t {
    number,      ///< The cell's own number, a word for draws of random numbers.
    area,  ///< In square units; of a cell that crawls 1. 0 in the padding of the last row.
    x, y, z,     ///< Its place in the model's box, whose longest side is 1, …
    sx, sy, sz,  ///< … and with every side 1.
    nx, ny, nz,  ///< The outward normal, of length 1.
    curvature,   ///< Turk's estimate, in 1 / unit.
    // Computed when they are first read (run/domain/surface_values.h).
    curvature_mean, curvature_high, curvature_low,  ///< In 1 / unit.
    curvature_gauss,                                ///< In 1 / unit².
    right_x, right_y, right_z,  ///< Where the angle 0 points, of length 1 (surface/cell_frames.h),
    down_x, down_y, down_z,     ///< and a quarter turn.
    evenness,                   ///< By which the ratio of a directed diffusion is limited, 0 … 1.
    place_x, place_y, place_z,  ///< The cell's place in units, from the middle of the model's box.
    // Of cells that crawl only, in lengths of scripts.
    off,      ///< The signed distance from the surface, positive on the side of the normal.
    feature,  ///< The square root of the area of the nearest triangle.
};
// clang-format on
inline constexpr std::size_t model_plane_count = 28;
// clang-format off
inline constexpr std::array<std::string_view, model_plane_count> model_names{
    "(number)", "(area)", "(x)", "(y)", "(z)", "(sx)", "(sy)", "(sz)", "(nx)", "(ny)", "(nz)",
    "(curvature)", "(curvature_mean)", "(curvature_high)", "(curvature_low)", "(curvature_gauss)",
    "(right_x)", "(right_y)", "(right_z)", "(down_x)", "(down_y)", "(down_z)", "(evenness)",
    "(place_x)", "(place_y)", "(place_z)", "(off)", "(feature)"};
// clang-format on
/// Is the plane only made for formulas that read it?
constexpr bool is_made_when_read(ModelPlane plane) { return plane >= ModelPlane::curvature_mean; }

using SystemId = Id<struct SystemTag>;  ///< Of Program::systems.
/// A quantity of a system, or after these `frozen` or `speed`.
using ItemId = Id<struct ItemTag>;
using DefinitionId = Id<struct DefinitionTag>;      ///< Of System::definitions.
using TextId = Id<struct TextTag>;                  ///< A text in quotes, in Literals.
using SurfaceValueId = Id<struct SurfaceValueTag>;  ///< In Literals.

/// An item of a stage.
struct StageItem {
    std::uint32_t stage = 0;
    ItemId item;
    bool operator==(const StageItem&) const = default;
};

/// An item of an earlier stage of fields, at the place of a cell that crawls.
struct SensedItem {
    StageItem item;
    bool operator==(const SensedItem&) const = default;
};

/// The rate of a species.
struct Rate {
    ItemId species;
    bool operator==(const Rate&) const = default;
};

/// True where the cell is inside the mask.
struct InsideMask {
    bool operator==(const InsideMask&) const = default;
};

/// What the kernel of a convolution knows of a lag, the vector from the cell to another one, whose
/// value it weights.
enum class LagPart : std::uint8_t {
    distance,  ///< Between their centres, in the script's unit.
    direction_x,
    direction_y,
    direction_z  ///< Of the unit vector along it; 0 at the distance 0.
};
inline constexpr std::size_t lag_part_count = 4;
inline constexpr std::array<std::string_view, lag_part_count> lag_part_names{
    "distance", "direction.x", "direction.y", "direction.z"};

/// The field that a constraint `0 = e` determines, by the number that its constraint has in
/// Literals. Only e reads it.
struct Unknown {
    std::uint32_t number = 0;
    bool operator==(const Unknown&) const = default;
};

/// A function of operands.
struct Call {
    /// Of noise its octaves; of the parts of `transport` the axis; of convolve the number of its
    /// kernel in Literals; of solved the number of its constraint; of functions of files the number
    /// of what is read.
    std::uint32_t detail = 0;
    bool operator==(const Call&) const = default;
};

/// What a node is. An ItemId is an item of this stage, a StageItem one of an earlier stage; of a
/// vector they are the first of its three components. Only lowering makes nodes of the kinds from
/// SurfaceValueId to LagPart, but that the checker makes of constants.
using NodeKind =
    std::variant<double, TextId, ItemId, StageItem, SensedItem, Builtin, CellValue, DefinitionId,
                 Rate, Call, SurfaceValueId, MetricPlane, ModelPlane, InsideMask, LagPart, Unknown>;

/// The position of a node in its formula or graph.
using NodeId = Id<struct NodeTag>;
using Operands = std::array<NodeId, most_operands>;

/// A node of a formula or of an expression graph. Operands are earlier nodes of the same list.
struct Node {
    NodeKind kind = 0.0;
    Span span = {};
    ValueType type = ValueType::number;
    Function function = Function::add;  ///< Of a call. Other kinds have no operands.
    std::uint8_t operand_count = 0;
    Operands operands{};

    template <typename Kind>
    bool is() const {
        return std::holds_alternative<Kind>(kind);
    }
    bool is(const NodeKind& other) const { return kind == other; }
    /// Null if it is of another kind.
    template <typename Kind>
    const Kind* as() const {
        return std::get_if<Kind>(&kind);
    }
    /// The operands in use.
    std::span<const NodeId> reads() const { return {operands.data(), operand_count}; }
    std::span<NodeId> reads() { return {operands.data(), operand_count}; }
    bool calls(Function called) const { return is<Call>() && function == called; }
};

/// Does the node draw random numbers?
inline bool is_draw(const Node& node) { return node.is<Call>() && is_random(node.function); }

/// Does the node draw a number of its own in each cell? Noise and lattices belong to places.
inline bool is_draw_in_cell(const Node& node) {
    return node.is<Call>() && info(node.function).kind == FunctionKind::draw;
}

/// Is the node an aggregate over the domain?
inline bool is_aggregate(const Node& node) {
    return node.is<Call>() && info(node.function).is_aggregate;
}

/// How a sum, mean, min or max over cells is computed; nothing for other functions.
std::optional<ReductionKind> reduction_of(Function function);

/// The operands whose values a node needs. Those of a constraint are computed while it is solved.
inline std::span<const NodeId> operands_of(const Node& node) {
    return node.calls(Function::solved) ? std::span<const NodeId>() : node.reads();
}

/// Is the node computed on whole planes?
inline bool is_nonlocal(const Node& node) { return node.is<Call>() && is_nonlocal(node.function); }

using Nodes = IdVector<NodeId, Node>;

/// A checked expression: nodes in order, the last being the whole. Never empty.
struct Formula {
    Nodes nodes;
};

/// The formula whose whole is `root`: the nodes of a list that `root` needs, directly or through
/// others, in their order.
Formula formula_of(const Nodes& nodes, NodeId root);

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

/// The time of a stage (spec/time.md).
struct StageTime {
    Solver solver = Solver::euler;
    Span solver_span;  ///< Where it was written, for messages.
    std::optional<double>
        tolerance;  ///< For steps of chosen length, as written; see step_tolerance().
    /// The limit of steps of chosen length.
    std::optional<double> largest_step;
    Span largest_step_span;  ///< Where that was written.
    /// The stage ends at this t; empty if it ends by its iterations.
    std::optional<double> duration;
    /// The duration is this number times the speed at the start of the stage.
    std::optional<std::int64_t> duration_in_steps;
    bool open_end = false;         ///< Ended by `until` alone, or by the largest number of steps.
    bool automatic_speed = false;  ///< The step is as long as stability and accuracy allow.
    std::optional<Formula> until;  ///< Ends the stage when it is true; the same in all cells.
    std::optional<double> steady;  ///< Ends the stage when its pattern has settled to this degree.
    std::optional<std::int64_t> check;  ///< Steps between two evaluations of `until`; see below.
    /// The stage first runs on a grid whose cells are this many times as wide; 1: it does not.
    std::int64_t coarse = 1;
    Span coarse_span;  ///< Where that was written.

    bool has_duration() const { return duration || duration_in_steps; }
    /// Are the lengths of steps chosen while the stage runs?
    bool chooses_steps() const { return automatic_speed || is_adaptive(solver); }
    /// The relative error of a step of chosen length.
    double step_tolerance() const {
        return tolerance.value_or(is_adaptive(solver) ? default_tolerance
                                                      : default_automatic_tolerance);
    }
    static constexpr double default_tolerance = 1e-4, default_automatic_tolerance = 1e-3;
    /// Steps that are as long as the state allows need more frequent checks.
    std::int64_t steps_between_looks() const {
        return check.value_or(chooses_steps() || takes_long_steps(solver) ? 10 : 100);
    }
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
    std::uint32_t species_count() const { return static_cast<std::uint32_t>(species().size()); }
};

/// The cells with which a stage of cells starts.
struct Founders {
    std::int64_t count = 0;      ///< Of those at random places; 0 if places are given.
    Formula chance;              ///< Of keeping a random place, from 0 to 1; empty: all.
    std::vector<double> places;  ///< Three coordinates of scripts for each.
    Span span;
};

/// The wavelength that the pattern of a stage is to have, `size: 16`.
struct StageSize {
    double wanted = 0;  ///< In units of the domain, like its spacing.
    Span span;          ///< Where it was written.
    /// Of a stage that ends by its steps, all of them; fewer may run.
    std::int64_t steps = 0;
    /// By how much lengths in the stage are scaled for that; with_lengths() has scaled them if it
    /// is not 1.
    double factor = 1;
};

struct Stage {
    std::string name;  ///< As written, or stage1, stage2, … by position.
    Span span;
    SystemId system;
    IdVector<ItemId, Formula> items;  ///< Starting value of every item.
    std::vector<ItemId> order;        ///< Items in an order in which each can be evaluated.
    IdVector<ItemId, bool> uniform;   ///< The same in all cells. Species never are.
    std::int64_t iterations = 0;      ///< With a duration: the largest number of steps.
    std::int64_t interval = 1;        ///< 0 if the stage is observed at tenths of the duration.
    Formula show;
    StageTime time;
    /// `grid: coarse(…)`: its cells are this many times as wide as those of the domain.
    std::int64_t coarse = 1;
    Span coarse_span;  ///< Where that was written.
    std::optional<StageSize> size;
    /// By species, in their order; empty if the boundary holds at all sides.
    IdVector<SpeciesId, SideSettings> sides;
    std::vector<DefinitionSides> definition_sides;  ///< In order of their definitions.
    // Of a stage of cells that crawl.
    std::optional<Founders> founders;  ///< Empty: the cells of the stage of cells before it.
    Formula remove;  ///< Cells where it is not 0 are removed at the start; empty: none.
    /// Above 0 inside of the body on whose surface they are, in a volume; read in the cells of its
    /// grid after the stages of fields that it reads. Empty: they are where they were in the stage
    /// of cells before; founders are on the domain's model or plane, or in its box.
    Formula body;
};

/// A surface in space on which the grid lies.
struct SurfaceSettings {
    std::array<Formula, 3> position;  ///< Of numbers, coordinates and functions of numbers.
    bool has_metric = true;           ///< False: cells count as squares.
    std::optional<double> unit;       ///< Length of one unit; empty: see DomainSettings::detail.
    Span span;
};

/// A domain of any shape: the cells of the grid that belong to it.
struct MaskSettings {
    Formula formula;  ///< Neither 0 nor NaN in cells of the domain. Reads no item.
    Span span;        ///< Of the expression.
};

/// The source of a surface over which cells are spread.
enum class ModelShape : std::uint8_t {
    file,
    sphere,
    torus,
    box,
    knot,
    creature,
    leopard,
    giraffe,
    zebra,
    fish,
    frog,
    implicit
};

/// What the cells are.
enum class ModelCellKind : std::uint8_t {
    spread,    ///< Points spread evenly, each with its Voronoi region (Turk).
    faces,     ///< The triangles of the model.
    vertices,  ///< Its points.
};

/// How differences between neighbours are weighted.
enum class ModelLaplacian : std::uint8_t {
    finite_volumes,  ///< The length of the Voronoi edge over the distance and the cell's area.
    turk,            ///< Lengths of Voronoi edges, scaled so that their sum is 4.
};

/// The direction in which cells, and patterns, are stretched.
struct DirectionSettings {
    enum class Kind : std::uint8_t { axis, gradient, curvature_high, curvature_low, keys };
    Kind kind = Kind::axis;
    /// For an axis its vector; for keys groups of a position and a vector.
    std::vector<double> numbers;
    std::optional<Formula> height;  ///< For a gradient: a formula of numbers and x, y and z.
    double smoothing = 0;           ///< Standard deviation, in longest sides of the model.
    Span span;
};

/// A surface in space whose cells are the domain: the file of a model, or a shape.
struct ModelSettings {
    ModelShape shape = ModelShape::file;
    std::string path;                 ///< For a file.
    std::vector<double> sizes;        ///< Of a torus (two radii), a box (three sides) or a knot.
    std::optional<Formula> implicit;  ///< The surface is where this is 0.
    ModelCellKind cells = ModelCellKind::spread;
    std::int64_t count = 16384;  ///< Of spread cells.
    ModelLaplacian laplacian = ModelLaplacian::finite_volumes;
    std::optional<double> unit;  ///< Length of one unit; empty: see DomainSettings::detail.
    Stance stance;               ///< What of the model becomes y and z of the script.
    std::optional<DirectionSettings> directions;
    double stretch = 2;  ///< The ratio of length to width of cells along the directions.
    Span span;           ///< Of the name of the model.
};

/// Values of a model's cells that come from places on it: distance(…), keys(…) and along(…) with
/// constant arguments.
struct SurfaceValue {
    Function function = Function::distance;
    std::vector<double> numbers;  ///< As written; of along(…) those of DirectionSettings.
    // Of along(…):
    DirectionSettings::Kind direction = DirectionSettings::Kind::axis;
    double smoothing = 0;

    friend bool operator==(const SurfaceValue&, const SurfaceValue&) = default;
};

/// What a function of a file reads of it.
struct FileReading {
    PictureChannel channel = PictureChannel::lightness;
    bool is_direction = false;  ///< The angle of the direction that a picture has painted.
    /// Where in the file, 0 … 1 from the left, from the top and from the first slice: formulas of
    /// numbers and of where the cell is. Empty: where the domain has it.
    std::vector<Formula> place = {};
};

/// A constraint `0 = e`, which determines a field.
struct Constraint {
    std::string unknown;  ///< The name of the field.
    Span span;            ///< Of e.
};

/// The kernel of a convolution: a formula of numbers, uniform parameters, and `distance` and
/// `direction` from the cell to the one that is weighted (CellValue).
struct ConvolutionKernel {
    Formula weight;
    Formula reach;  ///< Cells up to this distance count; empty: all cells of the domain.
};

/// The cells that operators of derivatives read on a grid.
enum class StencilKind : std::uint8_t {
    cross,      ///< Those beside the cell along the axes.
    isotropic,  ///< Those across two axes as well, in lap.
    fourth,     ///< Two cells along each axis, for errors of fourth order.
};

struct DomainSettings {
    Grid grid;                               ///< 64 × 64, periodic, unless said otherwise.
    std::optional<ModelSettings> model;      ///< Then the grid is linked.
    std::optional<MaskSettings> mask;        ///< Without one all cells of the grid.
    std::optional<SurfaceSettings> surface;  ///< Without one the plane.
    StencilKind stencil = StencilKind::cross;
    std::uint32_t seed = 1;
    Precision precision = Precision::single;  ///< Of all numbers of a run.
    bool fast = false;  ///< Steps are computed with fewer roundings (ir/contraction.h).
    /// Cells are this many times as short as the script says, along each axis, in a domain of the
    /// same lengths. On surfaces and models without a unit the mean cell has the area 1 / detail².
    std::int64_t detail = 1;
    /// Cells are this many times as wide as the script says, in a domain of the same lengths.
    std::int64_t coarse = 1;
    std::array<std::optional<SideSetting>, wall_count> sides;  ///< Of all species.
};

/// What formulas name by its number, as it does not fit into a Node. Entries never change; a view
/// of a checked program that names something new adds it at the end. From one thread at a time.
class Literals {
public:
    /// The id of an equal one, or of a new one.
    TextId id_of(const std::string& text);
    SurfaceValueId id_of(const SurfaceValue& value);
    /// The number of a new kernel, or of a new constraint.
    std::uint32_t add(ConvolutionKernel kernel);
    std::uint32_t add(Constraint constraint);
    /// The number of a new one; of an equal one, if it has no place.
    std::uint32_t add(FileReading reading);

    /// In quotes: the name of a palette, a path.
    const std::string& text(TextId id) const { return texts_[id.index()]; }
    const SurfaceValue& surface_value(SurfaceValueId id) const {
        return surface_values_[id.index()];
    }
    const ConvolutionKernel& kernel(std::uint32_t number) const { return kernels_[number]; }
    const Constraint& constraint(std::uint32_t number) const { return constraints_[number]; }
    const FileReading& reading(std::uint32_t number) const { return readings_[number]; }
    std::uint32_t reading_count() const { return static_cast<std::uint32_t>(readings_.size()); }
    auto text_ids() const { return ids_below<TextId>(texts_.size()); }

private:
    std::deque<std::string> texts_;
    std::deque<SurfaceValue> surface_values_;
    std::deque<ConvolutionKernel> kernels_;
    std::deque<Constraint> constraints_;
    std::deque<FileReading> readings_{FileReading{}};
};

struct Program {
    IdVector<SystemId, System> systems;  ///< Built-in ones first.
    std::vector<Stage> stages;
    DomainSettings domain;
    std::shared_ptr<Literals> literals =
        std::make_shared<Literals>();  ///< Never null; shared by copies.

    const System& system_of(std::uint32_t stage) const { return systems[stages[stage].system]; }
};

/// Calls visit(kernel) for the kernels of the convolutions in a formula.
template <typename Visit>
void for_each_kernel(const Formula& formula, const Literals& literals, const Visit& visit) {
    for (const Node& node : formula.nodes) {
        if (node.calls(Function::convolve)) visit(literals.kernel(node.as<Call>()->detail));
    }
}

/// Does a node of a formula of `stage` differ from cell to cell? `operand_differs` says whether one
/// of its operands does. Items of the stage that are not known yet count as different.
bool differs_by_cell(const Node& node, bool operand_differs, const Program& program,
                     std::uint32_t stage);

/// The program as text for `--dump program`: systems in use, stages, resolved formulas, orders, and
/// which values vary.
std::string print_program(const Program& program);

}  // namespace cascade
