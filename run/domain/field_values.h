// Properties of all values of a field.
#pragma once

#include "core/plane.h"
#include "run/domain/domain_mask.h"

#include <span>
#include <vector>

namespace cascade {

/// 1 where the value is not 0 (NaN counts as not 0, as everywhere in the language).
Mask to_mask(const Field& field);

/// Its values as numbers.
Field to_field(const Mask& mask, Precision precision);

/// The smallest value of a field's cells inside the mask. NaN if one is NaN.
double smallest(const Field& field, const DomainMask* mask);
/// The largest.
double largest_value(const Field& field, const DomainMask* mask);

/// The first value of each field, which is the value of all cells in uniform fields.
std::vector<double> first_values(std::span<const Field> fields);

/// Whether all cells hold the same word.
bool is_same_everywhere(const Field& field);

}  // namespace cascade
