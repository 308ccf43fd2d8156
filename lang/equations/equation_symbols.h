// Names and numbers in mathematical notation (internal to the printing of equations).
#pragma once

#include "lang/equations/equations.h"

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace cascade {

/// The notation for the names of one system.
struct Symbols {
    Notation notation = Notation::unicode;
    /// Unicode has few subscript letters: names get subscripts only if all names of the system can.
    bool subscripts = true;
    std::set<std::string, std::less<>> vectors;  ///< Names that TeX writes in bold.

    /// diff_u: diffᵤ, \mathrm{diff}_{u}; beta: β, \beta; p1: p₁, p_{1}.
    std::string name(std::string_view name) const;
    /// u[i+1], where `index` is the index as written: uᵢ₊₁. In TeX `index` is one word: u_{i}.
    std::string member(std::string_view family, std::string_view index) const;
    /// The name in TeX, in a form that can take an index as subscript.
    std::string family_in_tex(std::string_view family) const;
    /// 1e-3: 10⁻³, 10^{-3}. Other numbers as written.
    std::string number(std::string_view digits) const;
};

/// Escapes a text for TeX's text mode.
std::string tex_text(std::string_view text);

/// True if Unicode can write the part of a name after its first `_` as a subscript.
bool has_subscript(std::string_view name);

/// The text in Unicode's superscripts or subscripts. Empty if a character has no such form.
std::optional<std::string> superscript(std::string_view text);
std::optional<std::string> subscript(std::string_view text);

}  // namespace cascade
