// Computes the kind and size of a picture, and refuses pictures that are too large.
#pragma once

#include "core/result.h"
#include "lang/program/program.h"
#include "run/script/picture_request.h"
#include "run/script/script.h"

#include <array>
#include <cstdint>

namespace cascade {

/// Whether any stage that runs has crawling cells.
bool has_cells(const Script& script);

/// Whether pictures of the script show a body. With --slice or --flat they show a slice of the
/// volume and no body.
bool draws_body(const Script& script, const PictureRequest& request);

/// Whether pictures are drawn from a viewpoint in space. Pictures of models, surfaces, bodies and
/// crawling cells are.
bool draws_scene(const Script& script, const PictureRequest& picture);

/// Whether a picture of a plane or slice continues with a copy of itself. The first value applies
/// to its left and right sides, the second to its upper and lower sides.
std::array<bool, 2> sides_that_repeat(const Grid& grid, const Slice& slice);

/// Returns the size of a copy in a picture of a plane or slice. Such a picture may consist of
/// several copies.
PictureSize copy_size(const Grid& grid, const PictureRequest& picture);

PictureSize picture_size(const Script& script, const PictureRequest& picture);

/// Refuses pictures of more than 2²⁸ pixels, and pictures that do not fit into memory. `memory` is
/// the number of bytes that the run itself needs. If `memory_limit` is 0, there is no limit.
Result<void> check_picture_size(const Script& script, const PictureRequest& picture,
                                double memory = 0, std::uint64_t memory_limit = 0);

}  // namespace cascade
