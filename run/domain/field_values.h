// Functions of all values of a field, such as the smallest.
#pragma once

#include "core/plane.h"
#include "run/domain/domain_mask.h"

#include <span>
#include <vector>

namespace cascade {

/// A mask that is 1 where the value is not 0. NaN counts as a value other than 0, as everywhere in
/// the language.
Mask to_mask(const Field& field);

/// A field with the value 1 or 0 of the mask in each cell.
Field to_field(const Mask& mask, Precision precision);

/// The smallest value inside the mask, or of all cells if `mask` is null. NaN if a value is NaN.
double smallest(const Field& field, const DomainMask* mask);
/// The largest value inside the mask, or of all cells if `mask` is null. NaN if a value is NaN.
double largest_value(const Field& field, const DomainMask* mask);

/// The first value of each field. If a field is uniform, this is the value of all its cells.
std::vector<double> first_values(std::span<const Field> fields);

/// Whether all cells have the same value, bit for bit.
bool is_same_everywhere(const Field& field);

}  // namespace cascade
