// Names and numbers as mathematics writes them (internal to the printing of equations).
#pragma once

#include "lang/equations/equations.h"

#include <optional>
#include <string>
#include <string_view>

namespace cascade {

/// How the names of one system are written.
struct Symbols {
    Notation notation = Notation::unicode;
    /// Unicode has few letters to write below: names get them only where all names of a system can.
    bool subscripts = true;

    /// diff_u: diffᵤ, \mathrm{diff}_{u}; beta: β, \beta; p1: p₁, p_{1}.
    std::string name(std::string_view name) const;
    /// u[i+1], where `index` is the index as written: uᵢ₊₁. In TeX `index` is one word: u_{i}.
    std::string member(std::string_view family, std::string_view index) const;
    /// The name in TeX, such that an index can be written below it.
    std::string family_in_tex(std::string_view family) const;
    /// 1e-3: 10⁻³, 10^{-3}; others as written.
    std::string number(std::string_view digits) const;
};

/// Any text in TeX's text mode.
std::string tex_text(std::string_view text);

/// Can the part of a name after its first `_` be written below?
bool has_subscript(std::string_view name);

/// Written above or below in Unicode; nothing where a character has no such form.
std::optional<std::string> superscript(std::string_view text);
std::optional<std::string> subscript(std::string_view text);

}  // namespace cascade
