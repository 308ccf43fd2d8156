// Checked expressions. The nodes of an expression refer to items and definitions by ids, not by
// names.
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

/// The planes of a surface that operators read (surface/parameter_surface.h).
// clang-format off
enum class MetricPlane : std::uint8_t {
    inverse_11, inverse_12, inverse_22,  ///< The matrix Ṽ⁻¹.
    area,                                ///< s, the area of the cell.
    flow_11, flow_12, flow_22,  ///< The matrix s Ṽ⁻¹ Ṽ⁻ᵀ, by which differences become fluxes.
};
// clang-format on
inline constexpr std::size_t metric_plane_count = 7;
/// The names of the planes in dumps. A plane's name begins with a bracket, so that it differs from
/// all names in the language.
inline constexpr std::array<std::string_view, metric_plane_count> metric_names{
    "(metric 11)", "(metric 12)", "(metric 22)", "(area)", "(flow 11)", "(flow 12)", "(flow 22)"};

/// The planes of a model's cells that kernels read (run/domain/model_cells.h).
// clang-format off
enum class ModelPlane : std::uint8_t {
    number,  ///< The number of the cell: the word from which its random numbers are computed.
    /// The area of the cell in square units. 1 for crawling cells, and 0 in the padding of the last
    /// row.
    area,
    /// The position in the model's box if the box is scaled so that its longest side is 1.
    x, y, z,
    sx, sy, sz,  ///< The position in the model's box if every side of the box is scaled to 1.
    nx, ny, nz,  ///< The outward normal, of length 1.
    curvature,  ///< Turk's estimate of the curvature, in 1 / unit.
    // The following planes are computed when they are first read (run/domain/surface_values.h).

    /// The mean, the larger and the smaller of the principal curvatures, in 1 / unit.
    curvature_mean, curvature_high, curvature_low,
    curvature_gauss,  ///< The Gaussian curvature, in 1 / unit².
    right_x, right_y, right_z,  ///< The direction of angle 0 (surface/cell_frames.h), of length 1.
    down_x, down_y, down_z,  ///< The direction a quarter turn from `right`, of length 1.
    /// How evenly the cell's neighbours are spread, 0 … 1. The smaller it is, the less diffusion
    /// may differ between directions.
    evenness,
    /// The position, in units, relative to the middle of the model's box.
    place_x, place_y, place_z,
    // The following planes exist only for crawling cells. Lengths are in the script's unit.
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
/// Whether the plane is made only if a formula reads it.
constexpr bool is_made_when_read(ModelPlane plane) { return plane >= ModelPlane::curvature_mean; }

using SystemId = Id<struct SystemTag>;  ///< An index into Program::systems.
/// The number of an item of a system: a quantity, `frozen` or `speed`. Quantities come first.
using ItemId = Id<struct ItemTag>;
using DefinitionId = Id<struct DefinitionTag>;  ///< An index into System::definitions.
/// An index into the texts of Literals. A text is written in quotes.
using TextId = Id<struct TextTag>;
/// An index into the surface values of Literals.
using SurfaceValueId = Id<struct SurfaceValueTag>;

/// An item of an earlier stage.
struct StageItem {
    std::uint32_t stage = 0;
    ItemId item;
    bool operator==(const StageItem&) const = default;
};

/// An item of an earlier stage of fields, read at the position of a crawling cell.
struct SensedItem {
    StageItem item;
    bool operator==(const SensedItem&) const = default;
};

/// The rate of a species.
struct Rate {
    ItemId species;
    bool operator==(const Rate&) const = default;
};

/// 1 inside the mask, 0 outside.
struct InsideMask {
    bool operator==(const InsideMask&) const = default;
};

/// What the kernel of a convolution can read about the lag. The lag is the vector from the cell to
/// the cell whose value is weighted.
enum class LagPart : std::uint8_t {
    distance,  ///< The distance between the centres of both cells, in the script's unit.
    direction_x,
    direction_y,
    /// The three components of `direction` are a unit vector along the lag, or 0 at distance 0.
    direction_z
};
inline constexpr std::size_t lag_part_count = 4;
inline constexpr std::array<std::string_view, lag_part_count> lag_part_names{
    "distance", "direction.x", "direction.y", "direction.z"};

/// The field that a constraint `0 = e` determines. `number` is the index of the constraint in
/// Literals. Only e contains this node.
struct Unknown {
    std::uint32_t number = 0;
    bool operator==(const Unknown&) const = default;
};

/// A function with operands.
struct Call {
    /// A number whose meaning depends on the function. For noise it is the number of octaves, for
    /// the parts of `transport` the axis, and for `beside` the number of an Offset. For `convolve`,
    /// `solved` and functions that read files it is an index in Literals: of the kernel, of the
    /// constraint, or of the FileReading.
    std::uint32_t detail = 0;
    bool operator==(const Call&) const = default;
};

/// The kinds of nodes. An ItemId is an item of this stage, and a StageItem is an item of an earlier
/// stage. The id of a vector is the id of the first of its three components. Only lowering makes
/// the kinds from SurfaceValueId to LagPart, except that the checker makes each SurfaceValueId.
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
    /// The function of a call. Nodes of other kinds have no operands.
    Function function = Function::add;
    std::uint8_t operand_count = 0;
    Operands operands{};

    template <typename Kind>
    bool is() const {
        return std::holds_alternative<Kind>(kind);
    }
    bool is(const NodeKind& other) const { return kind == other; }
    /// The node's kind as a Kind. Null if the node is of another kind.
    template <typename Kind>
    const Kind* as() const {
        return std::get_if<Kind>(&kind);
    }
    /// The operands that the node has.
    std::span<const NodeId> reads() const { return {operands.data(), operand_count}; }
    std::span<NodeId> reads() { return {operands.data(), operand_count}; }
    bool calls(Function called) const { return is<Call>() && function == called; }
};

/// Whether the node draws random numbers.
inline bool is_draw(const Node& node) { return node.is<Call>() && is_random(node.function); }

/// Whether the node draws a separate number in each cell. Noise and lattices do not, because their
/// values depend on positions.
inline bool is_draw_in_cell(const Node& node) {
    return node.is<Call>() && info(node.function).kind == FunctionKind::draw;
}

/// Whether the node is an aggregate over the domain.
inline bool is_aggregate(const Node& node) {
    return node.is<Call>() && info(node.function).is_aggregate;
}

/// The reduction that a sum, mean, min or max over cells performs. nullopt for other functions.
std::optional<ReductionKind> reduction_of(Function function);

/// The operands whose values must be computed before the node. Empty for a constraint, because its
/// operand is computed while the constraint is solved.
inline std::span<const NodeId> operands_of(const Node& node) {
    return node.calls(Function::solved) ? std::span<const NodeId>() : node.reads();
}

/// Whether the node can only be computed from whole planes.
inline bool is_nonlocal(const Node& node) { return node.is<Call>() && is_nonlocal(node.function); }

using Nodes = IdVector<NodeId, Node>;

/// A checked expression: a list of nodes in which operands come before the nodes that read them.
/// The last node is the whole expression. Never empty.
struct Formula {
    Nodes nodes;
};

/// The formula whose last node is `root`. It consists of all nodes that `root` reads, directly or
/// indirectly, in the order that they have in `nodes`.
Formula formula_of(const Nodes& nodes, NodeId root);

}  // namespace cascade
