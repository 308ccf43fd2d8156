// Names and numbers in mathematical notation (internal to printing equations).
#pragma once

#include "lang/equations/equations.h"

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace cascade {

/// How the names of one system are written.
struct Symbols {
    Notation notation = Notation::unicode;
    /// Whether parts of names are written as subscripts. Unicode has few subscript letters, so in
    /// Unicode this is true only if every name in the system can be written with subscripts.
    bool subscripts = true;
    std::set<std::string, std::less<>> vectors;  ///< Names that TeX writes in bold.
    /// Names that the system or a function declares. Any other name that looks like u_xx is a
    /// derivative.
    std::set<std::string, std::less<>> declared;

    /// A name in this notation. Examples in Unicode and TeX: diff_u gives diffᵤ, \mathrm{diff}_{u};
    /// beta gives β, \beta; p1 gives p₁, p_{1}.
    std::string name(std::string_view name) const;
    /// A member of a family. `index` is written as in the script: i+1 gives uᵢ₊₁. For TeX, `index`
    /// must be one word: u_{i}.
    std::string member(std::string_view family, std::string_view index) const;
    /// The name of a family in TeX, in a form to which an index can be added as a subscript.
    std::string family_in_tex(std::string_view family) const;
    /// The texts before and after the operand of a derivative along axes such as xxy: ∂³ and
    /// /∂x²∂y, or \partial_{xxy} and nothing.
    std::pair<std::string, std::string> around_derivative(std::string_view axes) const;
    /// A number in this notation: 1e-3 gives 10⁻³ or 10^{-3}. A number without an exponent is
    /// unchanged.
    std::string number(std::string_view digits) const;
    /// The unit of a number, with a space before it: ` µm²/s`, `\,\mathrm{\mu m^{2}/s}`.
    std::string unit(std::string_view text) const;
};

/// Escapes a text for TeX's text mode.
std::string tex_text(std::string_view text);

/// Whether Unicode has a subscript for every character after the first `_` of the name.
bool has_subscript(std::string_view name);

/// The text in Unicode superscripts or subscripts. nullopt if Unicode has no such form of a
/// character in the text.
std::optional<std::string> superscript(std::string_view text);
std::optional<std::string> subscript(std::string_view text);

}  // namespace cascade
