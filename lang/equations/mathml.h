// Formulas in MathML, which browsers draw.
#pragma once

#include <string>
#include <string_view>

namespace cascade {

/// The longest formula in TeX that becomes MathML, in bytes.
inline constexpr std::size_t longest_mathml_source = 20'000;

/// The contents of a `math` element for a formula in the TeX of printed equations. Empty if the
/// formula is too long to be read as one.
std::string mathml_of(std::string_view tex);

}  // namespace cascade
