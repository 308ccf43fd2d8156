// Formulas in MathML, which browsers can draw.
#pragma once

#include <string>
#include <string_view>

namespace cascade {

/// The longest TeX formula that is converted to MathML, in bytes.
inline constexpr std::size_t longest_mathml_source = 20'000;

/// The contents of a `math` element for a TeX formula that equations.h has printed. Empty if the
/// formula is longer than the limit.
std::string mathml_of(std::string_view tex);

}  // namespace cascade
