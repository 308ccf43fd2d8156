// The table of units, and products, quotients and powers of units.
#include "lang/vocabulary/units.h"

#include "core/check.h"
#include "core/near_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

namespace cascade {

namespace {

/// A row of the table of units.
struct UnitRow {
    std::string_view name;
    std::string_view prefixes;  ///< The prefixes that the unit may have.
    std::string_view long_names;
    /// The powers of m, s, mol, kg, A and K in the unit.
    std::array<std::int8_t, base_quantity_count> powers;
    double times;
    int decimals;
};

// clang-format off
constexpr UnitRow unit_rows[] = {
    {"m",   "kdcmunpf", "metre meter metres meters",        {1, 0, 0, 0, 0, 0},   1, 0},
    {"s",   "munpf",    "sec second seconds",               {0, 1, 0, 0, 0, 0},   1, 0},
    {"min", "",         "minute minutes",                   {0, 1, 0, 0, 0, 0},   60, 0},
    {"h",   "",         "hour hours hr",                    {0, 1, 0, 0, 0, 0},   3600, 0},
    {"d",   "",         "day days",                         {0, 1, 0, 0, 0, 0},   86400, 0},
    {"week", "",        "weeks",                            {0, 1, 0, 0, 0, 0},   604800, 0},
    {"mol", "kmunpf",   "mole moles",                       {0, 0, 1, 0, 0, 0},   1, 0},
    {"M",   "munpf",    "molar",                            {-3, 0, 1, 0, 0, 0},  1, 3},
    {"l",   "dcmunpf",  "litre liter litres liters",        {3, 0, 0, 0, 0, 0},   1, -3},
    {"L",   "dcmunpf",  "",                                 {3, 0, 0, 0, 0, 0},   1, -3},
    {"g",   "kmunpf",   "gram grams",                       {0, 0, 0, 1, 0, 0},   1, -3},
    {"A",   "kmunpf",   "ampere amperes",                   {0, 0, 0, 0, 1, 0},   1, 0},
    {"K",   "mu",       "kelvin kelvins",                   {0, 0, 0, 0, 0, 1},   1, 0},
    {"Hz",  "GMkmu",    "hertz",                            {0, -1, 0, 0, 0, 0},  1, 0},
    {"N",   "Mkmunp",   "newton newtons",                   {1, -2, 0, 1, 0, 0},  1, 0},
    {"Pa",  "GMkmu",    "pascal pascals",                   {-1, -2, 0, 1, 0, 0}, 1, 0},
    {"J",   "Mkmunpf",  "joule joules",                     {2, -2, 0, 1, 0, 0},  1, 0},
    {"W",   "Mkmunp",   "watt watts",                       {2, -3, 0, 1, 0, 0},  1, 0},
    {"V",   "kmun",     "volt volts",                       {2, -3, 0, 1, -1, 0}, 1, 0},
    {"S",   "munp",     "siemens",                          {-2, 3, 0, -1, 2, 0}, 1, 0},
    {"F",   "munpf",    "farad farads",                     {-2, 4, 0, -1, 2, 0}, 1, 0},
    {"ohm", "GMkm",     "ohms",                             {2, -3, 0, 1, -2, 0}, 1, 0},
};
// clang-format on

/// The power of ten that a prefix stands for.
int decimals_of_prefix(char prefix) {
    switch (prefix) {
        case 'G': return 9;
        case 'M': return 6;
        case 'k': return 3;
        case 'd': return -1;
        case 'c': return -2;
        case 'm': return -3;
        case 'u': return -6;
        case 'n': return -9;
        case 'p': return -12;
        default: return -15;  // The prefix f.
    }
}

Unit unit_of_row(const UnitRow& row) {
    Unit unit;
    for (std::size_t k = 0; k < base_quantity_count; ++k) {
        unit.dimension.sixths[k] = static_cast<std::int16_t>(6 * row.powers[k]);
    }
    unit.times = row.times;
    unit.decimals = row.decimals;
    return unit;
}

bool has_long_name(const UnitRow& row, std::string_view name) {
    std::string_view rest = row.long_names;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(' '), rest.size());
        if (rest.substr(0, end) == name) return true;
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return false;
}

/// Divides the unit's `times` and `over` by their greatest common divisor.
Unit reduced(Unit unit) {
    constexpr double most = 0x1p53;
    if (unit.times > most || unit.over > most) return unit;
    const auto common = static_cast<double>(
        std::gcd(static_cast<std::int64_t>(unit.times), static_cast<std::int64_t>(unit.over)));
    unit.times /= common;
    unit.over /= common;
    return unit;
}

}  // namespace

Dimension operator*(const Dimension& a, const Dimension& b) {
    Dimension product;
    for (std::size_t k = 0; k < base_quantity_count; ++k) {
        product.sixths[k] = static_cast<std::int16_t>(a.sixths[k] + b.sixths[k]);
    }
    return product;
}

Dimension operator/(const Dimension& a, const Dimension& b) {
    Dimension quotient;
    for (std::size_t k = 0; k < base_quantity_count; ++k) {
        quotient.sixths[k] = static_cast<std::int16_t>(a.sixths[k] - b.sixths[k]);
    }
    return quotient;
}

std::optional<Dimension> to_power(const Dimension& dimension, double power) {
    constexpr double most = 6000;
    Dimension result;
    for (std::size_t k = 0; k < base_quantity_count; ++k) {
        const double exact = dimension.sixths[k] * power;
        const double whole = std::round(exact);
        if (!(std::abs(exact - whole) < 1e-9 && std::abs(whole) <= most)) return std::nullopt;
        result.sixths[k] = static_cast<std::int16_t>(whole);
    }
    return result;
}

Unit operator*(const Unit& a, const Unit& b) {
    return reduced(
        {a.dimension * b.dimension, a.times * b.times, a.over * b.over, a.decimals + b.decimals});
}

Unit operator/(const Unit& a, const Unit& b) {
    return reduced(
        {a.dimension / b.dimension, a.times * b.over, a.over * b.times, a.decimals - b.decimals});
}

Unit to_power(const Unit& unit, int power) {
    Unit result;
    for (int k = 0; k < std::abs(power); ++k) result = power > 0 ? result * unit : result / unit;
    return result;
}

double in_base_units(double number, const Unit& unit) {
    const double ten = std::pow(10.0, std::abs(unit.decimals));
    const double scaled = number * unit.times / unit.over;
    return unit.decimals < 0 ? scaled / ten : scaled * ten;
}

std::optional<Unit> unit_named(std::string_view name) {
    for (const UnitRow& row : unit_rows) {
        if (row.name == name || has_long_name(row, name)) return unit_of_row(row);
    }
    for (const UnitRow& row : unit_rows) {
        const bool fits = name.size() == row.name.size() + 1 && name.ends_with(row.name) &&
                          row.prefixes.find(name.front()) != std::string_view::npos;
        if (!fits) continue;
        Unit unit = unit_of_row(row);
        unit.decimals += decimals_of_prefix(name.front());
        return unit;
    }
    return std::nullopt;
}

std::string_view short_name_of_unit(std::string_view name) {
    for (const UnitRow& row : unit_rows) {
        if (has_long_name(row, name)) return row.name;
    }
    return name;
}

std::string advice_about_unknown_unit(std::string_view word) {
    if (word == "C" || word == "degC" || word == "celsius") {
        return "a temperature is a number of kelvins, such as '293 K'";
    }
    if (word == "deg" || word == "degree" || word == "degrees" || word == "rad") {
        return "angles are numbers of radians without a unit";
    }
    const std::size_t digits = word.find_first_of("0123456789");
    if (digits != std::string_view::npos && unit_named(word.substr(0, digits)) &&
        word.find_first_not_of("0123456789", digits) == std::string_view::npos) {
        return fmt::format("write '{}^{}'", word.substr(0, digits), word.substr(digits));
    }
    constexpr std::size_t shortest = 3, longest = 12;
    if (word.size() < shortest || word.size() > longest) return "";
    std::vector<std::string> names;
    for (const UnitRow& row : unit_rows) {
        names.emplace_back(row.name);
        for (const char prefix : row.prefixes) names.push_back(prefix + std::string(row.name));
        for (std::string_view rest = row.long_names; !rest.empty();) {
            const std::size_t end = std::min(rest.find(' '), rest.size());
            names.emplace_back(rest.substr(0, end));
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
    }
    const std::string near = nearest_name(word, names);
    return near.empty() ? "" : fmt::format("'{}' is not a unit; did you mean '{}'?", word, near);
}

std::vector<UnitFactor> factors_of_unit(std::string_view text) {
    std::vector<UnitFactor> factors;
    int sign = 1;
    if (text.starts_with("1/")) {
        text.remove_prefix(2);
        sign = -1;
    }
    while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of("*/"), text.size());
        const std::string_view factor = text.substr(0, end);
        const std::size_t caret = std::min(factor.find('^'), factor.size());
        int power = 1;
        if (caret < factor.size()) {
            std::from_chars(factor.data() + caret + 1, factor.data() + factor.size(), power);
        }
        factors.push_back({factor.substr(0, caret), sign * power});
        if (end == text.size()) break;
        sign = text[end] == '/' ? -1 : 1;
        text.remove_prefix(end + 1);
    }
    return factors;
}

Unit unit_of(std::string_view text) {
    Unit unit;
    for (const UnitFactor& factor : factors_of_unit(text)) {
        const auto named = unit_named(factor.name);
        CHECK(named, "the parser knows every unit that it accepts");
        unit = unit * to_power(*named, factor.power);
    }
    return unit;
}

}  // namespace cascade
