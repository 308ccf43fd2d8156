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

// The columns of functions.def, which explains each word.
// clang-format off
enum class FunctionKind : std::uint8_t {
    logic, comparison, arithmetic, elementary, choice,
    derivative, stencil, flux, link, nonlocal, draw, pattern, shape, text, landmarks,
    geometry, aggregate, colour,
};
// clang-format on
enum class ResultKind : std::uint8_t { number, vector, tensor, colour, like };
enum class Linear : std::uint8_t { none, each, together, first, last, after_first, but_last };
enum class Behaviour : std::uint8_t { plain, jumps, chooses, partial, divides, raises };
enum class Contexts : std::uint8_t { any, cells, rates, steps, values, noisy, picture };

/// The number of arguments of a function: a number, one of two, a range, or groups of values.
struct Arity {
    int least;
    int most;
    bool is_groups = false;  ///< Groups of `least` values, then up to most − least values.
    bool is_range = false;   ///< Any number from `least` to `most`.

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
/// Groups of `size` values, optionally followed by `after` more.
constexpr Arity groups_of(int size, int after = 0) {
    Arity arity{size, size + after};
    arity.is_groups = true;
    return arity;
}

/// The most operands of a function.
inline constexpr std::size_t most_operands = 6;

struct FunctionInfo {
    std::string_view spelling;
    Arity arity;
    int precedence;  ///< For operators. Other functions bind like names.
    FunctionKind kind;
    ResultKind result;
    Linear linear;
    int lengths;
    Contexts places;
    Domains domains;
    Behaviour behaviour;
    int cost;
    std::string_view meaning;

    bool is_operator = precedence < of_a_name;  ///< Spelled between or before its operands.
    bool is_aggregate = kind == FunctionKind::aggregate;
    /// It computes one number from many cells, such as `sum over near`.
    bool is_reduction = spelling.find(" over ") != std::string_view::npos;
    /// Called by its name, f(…): no operator, `sum over domain`, or product of lowering.
    bool is_named = !is_operator && spelling.find_first_of(" (") == std::string_view::npos;

    static constexpr int of_a_name = 9;
};
const FunctionInfo& info(Function function);

/// The function called by a name. Empty for operators and unknown names.
std::optional<Function> function_named(std::string_view name);
/// The function that sums (sum, mean, min, max) over `domain`, `touching` or `near`. Empty for
/// other words.
std::optional<Function> function_over(std::string_view name, std::string_view over);

/// True if it computes a number from numbers only. These functions are the rows of elementary.def.
inline bool is_elementary(Function function) { return info(function).kind <= FunctionKind::choice; }
inline bool is_comparison(Function function) {
    return info(function).kind == FunctionKind::comparison;
}
/// True if it computes the sum, mean, least or greatest of neighbours' values.
inline bool is_over_neighbours(Function function) {
    return info(function).kind == FunctionKind::link && info(function).is_reduction;
}
/// True if it reads its operand in all cells of a neighbourhood and is computed on whole planes.
inline bool is_nonlocal(Function function) { return info(function).kind == FunctionKind::nonlocal; }
/// True if it draws random numbers.
inline bool is_random(Function function) {
    const FunctionKind kind = info(function).kind;
    return kind == FunctionKind::draw || kind == FunctionKind::pattern;
}
/// True if it reads its last operand at neighbours (`div` reads at faces instead).
inline bool is_stencil(Function function) {
    const FunctionKind kind = info(function).kind;
    return kind == FunctionKind::derivative || kind == FunctionKind::stencil;
}
/// True for operators of derivatives and their vectors, whose values vary by cell only if an
/// operand does.
inline bool differentiates(Function function) {
    return is_stencil(function) || info(function).kind == FunctionKind::flux;
}
/// True if the value varies by cell, for some operands or for all.
inline bool varies_by_cell(Function function) {
    const FunctionKind kind = info(function).kind;
    // An angle is measured from a direction that differs from cell to cell.
    return (kind >= FunctionKind::derivative && kind <= FunctionKind::landmarks) ||
           function == Function::along;
}
/// True if it reads data named by a string (a file, an attribute of a model), stored in a separate
/// plane.
inline bool reads_file(Function function) { return info(function).kind == FunctionKind::text; }
/// True if it needs positions on the surface of a model, which a plane lacks.
inline bool needs_model(Function function) { return info(function).domains == Domains::model; }
/// True if the value jumps where operand `n` passes some number.
inline bool jumps_by(Function function, std::size_t n) {
    const Behaviour behaviour = info(function).behaviour;
    return behaviour == Behaviour::jumps || (behaviour == Behaviour::chooses && n == 0);
}

/// Whether a function of `count` operands is linear in operand `n` while the others are constant.
bool is_linear_in(Function function, std::size_t n, std::size_t count);
/// Whether it is linear in all its linear operands together, as a sum is and a product is not.
inline bool is_jointly_linear(Function function) {
    const Linear linear = info(function).linear;
    return linear == Linear::together || linear >= Linear::after_first;
}

/// The type of a value. In a system of fields a vector has a value in each cell and, inside of div,
/// a value at each face between cells (lang/program/field_vectors.h). In a system of crawling cells
/// it is three numbers, a position or a direction in space, which lowering splits first
/// (lang/lower/tissue_pass.cpp). No formula has both.
enum class ValueType : std::uint8_t { number, colour, text, vector, tensor };
/// The type of a function's result for operands of these types, if it has a meaning for them.
ValueType type_of_result(Function function, std::span<const ValueType> operands);

/// The axis of a vector's component called x, y or z.
std::optional<int> component_named(std::string_view name);

/// A derivative along the axes `first` and, if of second order, `second`: 0 is x, 1 y, 2 z.
struct Derivative {
    int order = 0;
    int first = 0;
    int second = 0;

    constexpr bool is_mixed() const { return order == 2 && first != second; }
};
inline constexpr std::array first_derivatives{Function::dx, Function::dy, Function::dz};
/// Which derivative dx, dxx or dxy is. Of order 0 for any other function.
Derivative derivative_of(Function function);

/// Values that every expression may read. `pi` is folded into a number.
// clang-format off
enum class Builtin : std::uint8_t {
    x, y, z, sx, sy, sz, t, step, nx, ny, nz,
    curvature, curvature_mean, curvature_gauss, curvature_high, curvature_low,
};
// clang-format on
inline constexpr std::size_t builtin_count = 16;
/// Their spellings, by Builtin.
// clang-format off
inline constexpr std::array<std::string_view, builtin_count> builtin_names{
    "x", "y", "z", "sx", "sy", "sz", "t", "step", "nx", "ny", "nz",
    "curvature", "curvature_mean", "curvature_gauss", "curvature_high", "curvature_low"};
// clang-format on
std::optional<Builtin> builtin_named(std::string_view name);
/// True for values that vary by cell on models only. On a plane they are constant.
constexpr bool is_of_model(Builtin builtin) { return builtin >= Builtin::nx; }

/// Values that only crawling cells have. Other systems may declare their names.
// clang-format off
enum class CellValue : std::uint8_t {
    off, feature, normal,  ///< Properties of the surface at the cell.
    ex, ey, ez,            ///< The axes of the cell's frame, of length 1.
    // For a link to a neighbour:
    distance,   ///< Between the centres.
    direction,  ///< The unit vector from the cell to the neighbour. 0 if both are at one position.
    gap,        ///< distance − (r + r'): below 0 where the cells overlap.
    overlap,    ///< max(−gap, 0).
    contact,    ///< 1 up to the distance r + r', falling linearly to 0 at `reach` times that.
};
// clang-format on
/// Their spellings, by CellValue.
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
/// True for values of a link, which are only known inside of sums over neighbours.
constexpr bool is_of_link(CellValue value) { return value >= CellValue::distance; }

}  // namespace cascade
