// Splits a name into a stem, digits and a subscript. The name of a Greek letter becomes the letter.
#include "lang/equations/equation_symbols.h"

#include "lang/vocabulary/greek_letters.h"
#include "lang/vocabulary/subscripts.h"
#include "lang/vocabulary/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>

namespace cascade {

namespace {

/// A superscript or subscript letter, digit or sign.
struct SmallLetter {
    std::string_view name;
    std::string_view unicode;
};

constexpr SmallLetter raised_letters[] = {
    {"0", "⁰"}, {"1", "¹"}, {"2", "²"}, {"3", "³"}, {"4", "⁴"}, {"5", "⁵"}, {"6", "⁶"},
    {"7", "⁷"}, {"8", "⁸"}, {"9", "⁹"}, {"-", "⁻"}, {"+", "⁺"}, {"n", "ⁿ"}, {"i", "ⁱ"},
};

constexpr SmallLetter lowered_letters[] = {
    {"0", "₀"}, {"1", "₁"}, {"2", "₂"}, {"3", "₃"}, {"4", "₄"}, {"5", "₅"}, {"6", "₆"}, {"7", "₇"},
    {"8", "₈"}, {"9", "₉"}, {"-", "₋"}, {"+", "₊"}, {"(", "₍"}, {")", "₎"}, {"a", "ₐ"}, {"e", "ₑ"},
    {"h", "ₕ"}, {"i", "ᵢ"}, {"j", "ⱼ"}, {"k", "ₖ"}, {"l", "ₗ"}, {"m", "ₘ"}, {"n", "ₙ"}, {"o", "ₒ"},
    {"p", "ₚ"}, {"r", "ᵣ"}, {"s", "ₛ"}, {"t", "ₜ"}, {"u", "ᵤ"}, {"v", "ᵥ"}, {"x", "ₓ"},
};

template <std::size_t count>
const SmallLetter* find(const SmallLetter (&letters)[count], std::string_view name) {
    const auto* const end = letters + count;
    const auto* const found =
        std::find_if(letters, end, [&](const SmallLetter& letter) { return letter.name == name; });
    return found == end ? nullptr : found;
}

template <std::size_t count>
std::optional<std::string> replaced(const SmallLetter (&letters)[count], std::string_view text) {
    std::string result;
    for (std::size_t k = 0; k < text.size(); ++k) {
        const SmallLetter* const letter = find(letters, text.substr(k, 1));
        if (letter == nullptr) return std::nullopt;
        result += letter->unicode;
    }
    return result;
}

/// The parts of a name: a stem, the digits after the stem, and a subscript after the first `_`.
struct NameParts {
    std::string_view stem, below;
    bool has_bar = false;  ///< Whether the name contains a `_`.
};

NameParts parts_of(std::string_view name) {
    const std::size_t bar = name.find('_', 1);
    if (bar != std::string_view::npos && bar + 1 < name.size()) {
        return {name.substr(0, bar), name.substr(bar + 1), true};
    }
    std::size_t digits = name.size();
    while (digits > 0 && is_digit(name[digits - 1])) --digits;
    if (digits == 0 || name[digits - 1] == '_') return {name, "", false};
    return {name.substr(0, digits), name.substr(digits), false};
}

/// A word of letters and digits in TeX's math mode.
std::string tex_word(std::string_view word) {
    // TeX has commands with the names of Greek letters. For `epsilon` and `phi`, the forms that are
    // common in papers are used.
    if (!greek_letter(word).empty() || word == "Delta") {
        const std::string variant = word == "epsilon" || word == "phi" ? "var" : "";
        return "\\" + variant + std::string(word);
    }
    const bool is_number = std::all_of(word.begin(), word.end(), is_digit);
    if (word.size() == 1 || is_number) return word == "_" ? "\\_" : std::string(word);
    std::string text = "\\mathrm{";
    for (const char c : word) text += c == '_' ? std::string("\\_") : std::string(1, c);
    return text + "}";
}

/// The text of a subscript in TeX: the words between `_`, separated by commas.
std::string tex_below(std::string_view words) {
    std::string text;
    while (true) {
        const std::size_t bar = words.find('_');
        const std::string_view word = words.substr(0, bar);
        if (!word.empty()) text += (text.empty() ? "" : ",") + tex_word(word);
        if (bar == std::string_view::npos) return text;
        words.remove_prefix(bar + 1);
    }
}

}  // namespace

std::string Symbols::unit(std::string_view text) const {
    const bool tex = notation == Notation::tex;
    std::string written, denominator;
    for (const UnitFactor& factor : factors_of_unit(text)) {
        const bool is_micro = factor.name.size() > 1 && factor.name.front() == 'u';
        std::string name(factor.name.substr(is_micro ? 1 : 0));
        if (is_micro) name = (tex ? "\\mu " : "µ") + name;
        const int power = std::abs(factor.power);
        if (power != 1 && tex) name += fmt::format("^{{{}}}", power);
        if (power != 1 && !tex) name += superscript(std::to_string(power)).value_or("");
        if (factor.power < 0) denominator += "/" + name;
        else written += (written.empty() ? "" : tex ? " \\cdot " : "·") + name;
    }
    written = (written.empty() ? "1" : written) + denominator;
    return tex ? "\\,\\mathrm{" + written + "}" : " " + written;
}

std::string tex_text(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '\\') {
            result += "\\textbackslash{}";
        } else if (c == '~' || c == '^') {
            result += std::string("\\") + c + "{}";
        } else {
            if (std::string_view("#$%&_{}").find(c) != std::string_view::npos) result += '\\';
            result += c;
        }
    }
    return result;
}

bool has_subscript(std::string_view name) {
    const NameParts parts = parts_of(name);
    return !parts.has_bar || subscript(parts.below).has_value();
}

std::optional<std::string> superscript(std::string_view text) {
    return replaced(raised_letters, text);
}
std::optional<std::string> subscript(std::string_view text) {
    return replaced(lowered_letters, text);
}

std::string Symbols::name(std::string_view name) const {
    const NameParts parts = parts_of(name);
    if (notation == Notation::tex) {
        const std::string word = tex_word(parts.stem);
        const bool is_greek = !greek_letter(parts.stem).empty();
        const std::string stem = !vectors.contains(name) ? word
                                 : is_greek              ? "\\boldsymbol{" + word + "}"
                                                         : "\\mathbf{" + tex_text(parts.stem) + "}";
        const std::string under = tex_below(parts.below);
        return under.empty() ? stem : stem + "_{" + under + "}";
    }
    const std::string_view letter = greek_letter(parts.stem);
    const std::string stem(letter.empty() ? parts.stem : letter);
    const auto under = subscript(parts.below);
    if (under && (subscripts || !parts.has_bar)) return stem + *under;
    return stem + (parts.has_bar ? "_" : "") + std::string(parts.below);
}

std::string Symbols::family_in_tex(std::string_view family) const {
    const std::string stem = name(family);
    return stem.find("_{") == std::string::npos ? stem : "{" + stem + "}";
}

std::string Symbols::member(std::string_view family, std::string_view index) const {
    std::string tight;
    for (const char c : index) {
        if (c != ' ' && c != '\t' && c != '\n' && c != '\r') tight += c;
    }
    if (notation == Notation::tex) {
        const std::size_t comma = tight.find(',');
        std::string words = tex_word(tight.substr(0, comma));
        if (comma != std::string::npos) words += ", " + tex_word(tight.substr(comma + 1));
        return family_in_tex(family) + "_{" + words + "}";
    }
    const auto under = subscript(tight);
    const bool is_free = parts_of(family).below.empty();
    return under && is_free ? name(family) + *under : name(family) + "[" + tight + "]";
}

std::pair<std::string, std::string> Symbols::around_derivative(std::string_view axes) const {
    if (notation == Notation::tex) return {"\\partial_{" + std::string(axes) + "} ", ""};
    const auto power = [](std::size_t order) {
        return order == 1 ? "" : superscript(std::to_string(order)).value_or("");
    };
    const auto orders = orders_along(axes);
    std::string below = "/";
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (orders[axis] > 0) below += std::string("∂") + "xyz"[axis] + power(orders[axis]);
    }
    return {"∂" + power(axes.size()), below};
}

std::string Symbols::number(std::string_view digits) const {
    const std::size_t mark = digits.find_first_of("eE");
    if (mark == std::string_view::npos) return std::string(digits);
    const std::string_view significand = digits.substr(0, mark);
    std::string_view exponent = digits.substr(mark + 1);
    if (exponent.starts_with('+')) exponent.remove_prefix(1);
    const bool is_one = significand == "1" || significand == "1.0";
    if (notation == Notation::tex) {
        const std::string power = "10^{" + std::string(exponent) + "}";
        return is_one ? "{" + power + "}"
                      : "{" + std::string(significand) + " \\cdot " + power + "}";
    }
    const std::string power = "10" + superscript(exponent).value_or("^" + std::string(exponent));
    return is_one ? power : std::string(significand) + "·" + power;
}

}  // namespace cascade
