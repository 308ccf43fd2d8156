// The functions, operators and built-in names of the language, and their properties.
#pragma once

#include "lang/vocabulary/domains.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace cascade {

/// The functions and operators of functions.def.
enum class Function : std::uint8_t {
#define CASCADE_FUNCTION(id, ...) id,
#include "lang/vocabulary/functions.def"
};

inline constexpr std::size_t function_count = 0
#define CASCADE_FUNCTION(...) +1
#include "lang/vocabulary/functions.def"
    ;

// The columns of functions.def, where each word is explained. clang-format off
enum class FunctionKind : std::uint8_t {
    logic,
    comparison,
    arithmetic,
    elementary,
    choice,
    derivative,
    stencil,
    flux,
    link,
    nonlocal,
    draw,
    pattern,
    shape,
    text,
    landmarks,
    geometry,
    aggregate,
    colour,
};
// clang-format on
enum class ResultKind : std::uint8_t { number, vector, tensor, colour, like };
enum class Linear : std::uint8_t { none, each, together, first, last, after_first, but_last };
enum class Behaviour : std::uint8_t { plain, jumps, chooses, partial, divides, raises };
enum class Contexts : std::uint8_t { any, cells, rates, steps, values, noisy, picture };

/// The numbers of arguments that a function accepts: one fixed number, either of two numbers, any
/// number in a range, or groups of a fixed size.
struct Arity {
    int least;
    int most;
    /// Whether the arguments are groups of `least` each, followed by either none or most − least
    /// more arguments.
    bool is_groups = false;
    /// Whether any number from `least` to `most` is accepted. Otherwise only these two numbers are.
    bool is_range = false;

    constexpr Arity(int count) : least(count), most(count) {}
    constexpr Arity(int fewer, int more) : least(fewer), most(more) {}
    constexpr bool takes(std::size_t count) const {
        const auto fewer = static_cast<std::size_t>(least), more = static_cast<std::size_t>(most);
        if (is_range) return count >= fewer && count <= more;
        if (!is_groups) return count == fewer || count == more;
        return count >= fewer && (count % fewer == 0 || count % fewer == more - fewer);
    }
};
constexpr Arity either(int fewer, int more) { return {fewer, more}; }
constexpr Arity up_to(int least, int most) {
    Arity arity{least, most};
    arity.is_range = true;
    return arity;
}
/// Groups of `size` arguments each. After the last group, there may be `after` more arguments.
constexpr Arity groups_of(int size, int after = 0) {
    Arity arity{size, size + after};
    arity.is_groups = true;
    return arity;
}

/// The largest number of operands of a function.
inline constexpr std::size_t most_operands = 6;

struct FunctionInfo {
    std::string_view spelling;
    Arity arity;
    /// The precedence of an operator. A function that is not an operator has the precedence of a
    /// name.
    int precedence;
    FunctionKind kind;
    ResultKind result;
    Linear linear;
    int lengths;
    Contexts places;
    Domains domains;
    Behaviour behaviour;
    int cost;
    std::string_view meaning;

    /// Whether the function is written between or before its operands.
    bool is_operator = precedence < of_a_name;
    bool is_aggregate = kind == FunctionKind::aggregate;
    /// Whether the function computes one number from the values of many cells, as `sum over near`
    /// does.
    bool is_reduction = spelling.find(" over ") != std::string_view::npos;
    /// Whether the function is called by its name, f(…). False for operators, for functions such as
    /// `sum over domain`, and for functions that only lowering makes.
    bool is_named = !is_operator && spelling.find_first_of(" (") == std::string_view::npos;

    static constexpr int of_a_name = 9;
};
const FunctionInfo& info(Function function);

/// The function that is called by this name. Empty if the name is an operator or unknown.
std::optional<Function> function_named(std::string_view name);
/// The function that computes `name` (sum, mean, min or max) over `over` (`domain`, `touching` or
/// `near`). Empty for other words.
std::optional<Function> function_over(std::string_view name, std::string_view over);

/// Whether the function computes a number from numbers only. These functions are the rows of
/// elementary.def.
inline bool is_elementary(Function function) { return info(function).kind <= FunctionKind::choice; }
inline bool is_comparison(Function function) {
    return info(function).kind == FunctionKind::comparison;
}
/// Whether the function computes the sum, the mean, the smallest or the largest of the neighbours'
/// values.
inline bool is_over_neighbours(Function function) {
    return info(function).kind == FunctionKind::link && info(function).is_reduction;
}
/// Whether the function reads its operand in all cells of a neighbourhood. Such a function is
/// computed on whole planes.
inline bool is_nonlocal(Function function) { return info(function).kind == FunctionKind::nonlocal; }
/// Whether the function draws random numbers.
inline bool is_random(Function function) {
    const FunctionKind kind = info(function).kind;
    return kind == FunctionKind::draw || kind == FunctionKind::pattern;
}
/// Whether the function reads its last operand in neighbouring cells. `div` does not, because it
/// reads its operand at faces.
inline bool is_stencil(Function function) {
    const FunctionKind kind = info(function).kind;
    return kind == FunctionKind::derivative || kind == FunctionKind::stencil;
}
/// Whether the function takes a derivative, or makes a vector of which another function takes a
/// derivative. The result varies by cell only if an operand varies by cell.
inline bool differentiates(Function function) {
    return is_stencil(function) || info(function).kind == FunctionKind::flux;
}
/// Whether the function may give different values in different cells even if its operands are the
/// same in all cells.
inline bool varies_by_cell(Function function) {
    const FunctionKind kind = info(function).kind;
    // `along` measures an angle from a direction that differs from cell to cell.
    return (kind >= FunctionKind::derivative && kind <= FunctionKind::landmarks) ||
           function == Function::along;
}
/// Whether the function reads data that a string names, such as a file or an attribute of a model.
/// A separate plane stores the data.
inline bool reads_file(Function function) { return info(function).kind == FunctionKind::text; }
/// Whether the function needs positions on the surface of a model.
inline bool needs_model(Function function) { return info(function).domains == Domains::model; }
/// Whether the function's value jumps at certain values of operand `n`.
inline bool jumps_by(Function function, std::size_t n) {
    const Behaviour behaviour = info(function).behaviour;
    return behaviour == Behaviour::jumps || (behaviour == Behaviour::chooses && n == 0);
}

/// Whether a function with `count` operands is linear in operand `n` while the other operands are
/// constant.
bool is_linear_in(Function function, std::size_t n, std::size_t count);
/// Whether a function is linear in its linear operands together, and not only in each of them. A
/// sum is, but a product is not.
inline bool is_jointly_linear(Function function) {
    const Linear linear = info(function).linear;
    return linear == Linear::together || linear >= Linear::after_first;
}

/// The type of a value. In a system of fields, a vector has a value in each cell and, inside of
/// div, a value at each face between cells (lang/program/field_vectors.h). In a system of crawling
/// cells, a vector is three numbers, a position or a direction in space. Lowering splits such a
/// vector into its numbers first (lang/lower/tissue_pass.cpp). No formula contains vectors of both
/// kinds.
enum class ValueType : std::uint8_t { number, colour, text, vector, tensor };
/// The type of a function's result for operands of these types. If the function is not defined for
/// these types, the result is arbitrary.
ValueType type_of_result(Function function, std::span<const ValueType> operands);

/// The axis (0, 1 or 2) that the name x, y or z of a vector's component means. Empty for other
/// names.
std::optional<int> component_named(std::string_view name);

/// A derivative along the axis `first` and, if the order is 2, also along the axis `second`. Axis 0
/// is x, 1 is y, and 2 is z.
struct Derivative {
    int order = 0;
    int first = 0;
    int second = 0;

    constexpr bool is_mixed() const { return order == 2 && first != second; }
};
inline constexpr std::array first_derivatives{Function::dx, Function::dy, Function::dz};
/// The axes and the order of the derivative that a function such as dx, dxx or dxy takes. The order
/// is 0 if the function is not a derivative.
Derivative derivative_of(Function function);

/// Values that every expression may read. `pi` is not among these values, because it becomes a
/// number.
// clang-format off
enum class Builtin : std::uint8_t {
    x, y, z, sx, sy, sz, t, step, nx, ny, nz,
    curvature, curvature_mean, curvature_gauss, curvature_high, curvature_low,
};
// clang-format on
inline constexpr std::size_t builtin_count = 16;
/// The spellings of the values, indexed by Builtin.
// clang-format off
inline constexpr std::array<std::string_view, builtin_count> builtin_names{
    "x", "y", "z", "sx", "sy", "sz", "t", "step", "nx", "ny", "nz",
    "curvature", "curvature_mean", "curvature_gauss", "curvature_high", "curvature_low"};
// clang-format on
std::optional<Builtin> builtin_named(std::string_view name);
/// Whether the value varies by cell on models, and is constant on a plane.
constexpr bool is_of_model(Builtin builtin) { return builtin >= Builtin::nx; }

/// Values that only crawling cells have. In other systems, scripts may declare these names.
// clang-format off
enum class CellValue : std::uint8_t {
    off, feature, normal,  ///< Properties of the surface at the cell's position.
    ex, ey, ez,            ///< The axes of the cell's frame, of length 1.
    // The following values belong to the link from a cell to a neighbour.
    distance,  ///< The distance between the centres of the two cells.
    /// The direction from the cell to the neighbour, of length 1; 0 if both have the same position.
    direction,
    gap,  ///< distance − (r + r'). Negative where the cells overlap.
    overlap,    ///< max(−gap, 0).
    /// 1 up to the distance r + r'. Beyond this distance, falls linearly, to 0 at the distance
    /// reach · (r + r').
    contact,
};
// The spellings of the values, indexed by CellValue.
inline constexpr std::array<std::string_view, 11> cell_value_names{
    "off",      "feature",   "normal", "ex",      "ey",     "ez",
    "distance", "direction", "gap",    "overlap", "contact"};
std::optional<CellValue> cell_value_named(std::string_view name);
constexpr bool is_vector(CellValue value) {
    return (value >= CellValue::normal && value <= CellValue::ez) || value == CellValue::direction;
}
constexpr bool is_of_frame(CellValue value) {
    return value >= CellValue::ex && value <= CellValue::ez;
}
/// Whether the value belongs to a link, so that only sums over neighbours can read it.
constexpr bool is_of_link(CellValue value) { return value >= CellValue::distance; }

}  // namespace cascade
