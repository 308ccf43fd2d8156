// The functions, operators and built-in names of the language, and what each is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace cascade {

/// The functions and operators of functions.def.
enum class Function : std::uint8_t {
#define CASCADE_FUNCTION(id, spelling, arity, places, meaning) id,
#include "lang/vocabulary/functions.def"
#undef CASCADE_FUNCTION
};

inline constexpr std::size_t function_count = 0
#define CASCADE_FUNCTION(id, spelling, arity, places, meaning) +1
#include "lang/vocabulary/functions.def"
#undef CASCADE_FUNCTION
    ;

enum class Places : std::uint8_t { any, cells, rates, values, noisy, picture };

/// How many values a function takes: one number, one of two, or groups of values.
struct Arity {
    int least;
    int most;
    bool is_groups = false;  ///< `least` values, once or more often; most − least may follow.

    constexpr Arity(int count) : least(count), most(count) {}
    constexpr Arity(int fewer, int more) : least(fewer), most(more) {}
    constexpr bool takes(std::size_t count) const {
        const auto fewer = static_cast<std::size_t>(least), more = static_cast<std::size_t>(most);
        if (!is_groups) return count == fewer || count == more;
        return count >= fewer && (count % fewer == 0 || count % fewer == more - fewer);
    }
};
constexpr Arity either(int fewer, int more) { return {fewer, more}; }
/// Groups of so many values; behind them there may be so many more.
constexpr Arity groups_of(int size, int behind = 0) {
    Arity arity{size, size + behind};
    arity.is_groups = true;
    return arity;
}

/// The most values that a function takes.
inline constexpr std::size_t most_operands = 6;
using Operands = std::array<std::uint32_t, most_operands>;

struct FunctionInfo {
    std::string_view spelling;
    Arity arity;
    Places places;
    std::string_view meaning;
    bool is_operator;   ///< Spelled between or before its operands.
    bool is_aggregate;  ///< Spelled `mean over domain`, written mean(e over domain).
};
const FunctionInfo& info(Function function);

/// The function of a name that is called; nothing for operators and unknown names.
std::optional<Function> function_named(std::string_view name);

/// Whether the function draws random numbers.
bool is_random(Function function);

/// Whether the value differs from cell to cell whatever the operands are.
bool varies_by_cell(Function function);

/// Does it read what a text names (a file, an attribute of a model), which lies in a plane of its own?
bool reads_file(Function function);

/// Is it about places on the surface of a model, which a plane does not have?
bool needs_model(Function function);

/// Is it an operator of derivatives, or a vector that one takes? Such a function differs from cell
/// to cell only where an operand does.
bool differentiates(Function function);

/// Values that every expression may read. `pi` is folded into a number.
enum class Builtin : std::uint8_t {
    x, y, z, sx, sy, sz, t, step, nx, ny, nz,
    curvature, curvature_mean, curvature_gauss, curvature_high, curvature_low,
};
inline constexpr std::size_t builtin_count = 16;
/// How they are written, by Builtin.
inline constexpr std::array<std::string_view, builtin_count> builtin_names{
    "x", "y", "z", "sx", "sy", "sz", "t", "step", "nx", "ny", "nz",
    "curvature", "curvature_mean", "curvature_gauss", "curvature_high", "curvature_low"};
std::optional<Builtin> builtin_named(std::string_view name);
/// Does only a model tell one cell from another by it? On a plane it is a number.
constexpr bool is_of_model(Builtin builtin) { return builtin >= Builtin::nx; }

}  // namespace cascade
