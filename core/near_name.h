// "Did you mean …?": the nearest of a set of names.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace cascade {

/// The candidate with the smallest Damerau-Levenshtein distance (insertions, deletions,
/// replacements, swaps of neighbours, ignoring case), and the first of equally near candidates. The
/// distance must be at most 1 or a third of the length of `name`, and some letter must be
/// unchanged. Empty if no candidate is that near. Names longer than 64 bytes have no near name.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

}  // namespace cascade
