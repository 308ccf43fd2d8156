// "Did you mean …?": the nearest of a set of names.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace cascade {

/// The candidate with the smallest Damerau-Levenshtein distance (insert, delete, replace, swap of
/// neighbours, upper and lower case alike) if that is small for the length of `name`: at most a
/// third of its length, at least 1, with some letter left as it was. The first of several; empty
/// when nothing is near. Names longer than 64 bytes have no near name.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

}  // namespace cascade
