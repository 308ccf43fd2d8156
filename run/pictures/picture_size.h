// The size of a picture, and its limits.
#pragma once

#include "core/result.h"
#include "lang/program/program.h"
#include "run/script/picture_request.h"
#include "run/script/script.h"

#include <array>
#include <cstdint>

namespace cascade {

/// True if pictures are drawn from a viewpoint in space: for models, surfaces, bodies and crawling
/// cells.
bool draws_scene(const Script& script, const PictureRequest& picture);

/// Whether a picture of the plane, or of a slice, continues at its left and right sides, and at its
/// upper and lower ones, with a copy of itself.
std::array<bool, 2> sides_that_repeat(const Grid& grid, const Slice& slice);

/// The size of one of the copies that form a picture of the plane, or of a slice.
PictureSize copy_size(const Grid& grid, const PictureRequest& picture);

PictureSize picture_size(const Script& script, const PictureRequest& picture);

/// Refuses pictures of more than 2²⁸ pixels, and those that do not fit into memory. `memory` is the
/// run's own requirement, in bytes. 0 means no limit.
Result<void> check_picture_size(const Script& script, const PictureRequest& picture,
                                double memory = 0, std::uint64_t memory_limit = 0);

}  // namespace cascade
