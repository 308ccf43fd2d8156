// Fields as pictures show them: in binary32, and only one slice of a volume.
#pragma once

#include "core/plane.h"
#include "run/domain/domain_mask.h"
#include "run/script/picture_request.h"

namespace cascade {

/// Prepares a field for painting: converts it to binary32, and cuts the requested slice of a
/// volume.
Field shown(Field field, const PictureRequest& request);

/// Prepares a copy of a field for painting. Cells outside the mask, which may be null, become NaN.
Field as_shown(const Field& field, const DomainMask* mask, const PictureRequest& request);

}  // namespace cascade
