// Functions of all values of a field, such as the smallest value.
#pragma once

#include "core/plane.h"
#include "run/domain/domain_mask.h"

#include <span>
#include <vector>

namespace cascade {

/// Makes a mask that is 1 where the value is not 0. As everywhere in the language, NaN counts as a
/// value that is not 0.
Mask to_mask(const Field& field);

/// Makes a field that has in each cell the value of the mask, 1 or 0.
Field to_field(const Mask& mask, Precision precision);

/// Returns the smallest value inside the mask, or of all cells if `mask` is null. Returns NaN if a
/// value is NaN.
double smallest(const Field& field, const DomainMask* mask);
/// Returns the largest value inside the mask, or of all cells if `mask` is null. Returns NaN if a
/// value is NaN.
double largest_value(const Field& field, const DomainMask* mask);

/// Returns the value of the first cell of each field. If a field is uniform, all its cells have
/// this value.
std::vector<double> first_values(std::span<const Field> fields);

/// Whether all cells have the same value, bit for bit.
bool is_same_everywhere(const Field& field);

}  // namespace cascade
