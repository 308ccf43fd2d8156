// Long equations in TeX, over several lines of an align environment.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// How many signs of a formula fit on a line of a page.
inline constexpr int signs_of_a_line = 60;

/// How wide a formula of TeX is, about: its letters, digits and signs. Both parts of a fraction
/// count.
int width_in_signs(std::string_view formula);

/// A sum in pieces that fit on a line each as far as its terms do. Pieces begin with their sign but
/// for the first. Sums in brackets, in fractions and in roots stay whole, but for a long fraction
/// that is the whole formula: it becomes a sum in brackets after 1 / its denominator.
std::vector<std::string> broken_sum(std::string_view formula);

}  // namespace cascade
