// Which term of a rate drives a cell that crawls.
#pragma once

#include "run/simulation/stage_view.h"

#include <cstdint>
#include <string>

namespace cascade {

/// Names the term that is largest, by magnitude, in the rate of a species of the cell with this
/// number, at the present state: "the largest term of p' is …, 3.2e+09", or the first that is not
/// finite. Empty if the rate has one term only, if no such cell lives, or if all terms are 0 in it.
std::string largest_term(const StageView& view, SpeciesId species, std::uint32_t number);

}  // namespace cascade
