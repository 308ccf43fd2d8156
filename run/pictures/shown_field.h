// Converts fields to the form in which pictures show them: binary32, and a single slice of a
// volume.
#pragma once

#include "core/plane.h"
#include "run/domain/domain_mask.h"
#include "run/script/picture_request.h"

namespace cascade {

/// Prepares a field for painting: converts it to binary32, and cuts the requested slice of a
/// volume.
Field shown(Field field, const PictureRequest& request);

/// Prepares a copy of a field for painting. Cells outside the mask become NaN. If `mask` is null,
/// there is no mask.
Field as_shown(const Field& field, const DomainMask* mask, const PictureRequest& request);

}  // namespace cascade
