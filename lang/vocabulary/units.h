// Units of numbers, such as m, h, uM or m^2/s, with their dimensions and sizes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// What a unit measures. `amount` is the amount of a substance, in moles.
enum class BaseQuantity : std::uint8_t { length, time, amount, mass, current, temperature };
inline constexpr std::size_t base_quantity_count = 6;

/// The powers of the base quantities in a unit. The powers are stored in sixths, so that square
/// roots and cube roots of units have a dimension, too.
struct Dimension {
    std::array<std::int16_t, base_quantity_count> sixths{};

    static Dimension of(BaseQuantity quantity, int power = 1) {
        Dimension dimension;
        dimension.sixths[static_cast<std::size_t>(quantity)] = static_cast<std::int16_t>(6 * power);
        return dimension;
    }
    /// Whether this is the dimension of a number without a unit.
    bool is_none() const { return *this == Dimension{}; }
    std::int16_t operator[](BaseQuantity quantity) const {
        return sixths[static_cast<std::size_t>(quantity)];
    }
    bool operator==(const Dimension&) const = default;
};

Dimension operator*(const Dimension& a, const Dimension& b);
Dimension operator/(const Dimension& a, const Dimension& b);
/// Raises a dimension to a power. Empty unless every power in the result is a multiple of 1/6 and
/// at most 1000 in magnitude.
std::optional<Dimension> to_power(const Dimension& dimension, double power);

/// A unit is `times / over * 10^decimals` in terms of m, s, mol, kg, A and K. `times` and `over`
/// are integers.
struct Unit {
    Dimension dimension;
    double times = 1, over = 1;
    int decimals = 0;
};
Unit operator*(const Unit& a, const Unit& b);
Unit operator/(const Unit& a, const Unit& b);
/// Raises a unit to an integer power.
Unit to_power(const Unit& unit, int power);
/// Converts a number from `unit` to the base units m, s, mol, kg, A and K.
double in_base_units(double number, const Unit& unit);

/// The unit with this name, with or without a prefix, such as m, um or hour. Empty for other words.
std::optional<Unit> unit_named(std::string_view name);
/// The short name of the unit that `name` means: h for hour. If `name` is already short, the result
/// is `name`.
std::string_view short_name_of_unit(std::string_view name);
/// A hint about a word that was written as a unit but is not one. Empty if there is no hint.
std::string advice_about_unknown_unit(std::string_view word);

/// A factor of a unit: m^2 in m^2/s.
struct UnitFactor {
    std::string_view name;
    int power = 1;
};
/// The factors of a unit, such as m^2/s, mol*l^-1 or 1/s.
std::vector<UnitFactor> factors_of_unit(std::string_view text);
/// The unit that this text means.
Unit unit_of(std::string_view text);

/// In the syntax tree, `3 m^2/s` is a call of a function with one argument, 3. The name of this
/// function is a blank and the text of the unit. No script can write such a name.
inline bool is_unit_call(std::string_view function) { return function.starts_with(' '); }
inline std::string_view text_of_unit_call(std::string_view function) { return function.substr(1); }

}  // namespace cascade
