// Checked expressions: nodes whose names are resolved.
#pragma once

#include "core/id.h"
#include "core/source.h"
#include "ir/reduction.h"
#include "lang/vocabulary/functions.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

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

}  // namespace cascade
