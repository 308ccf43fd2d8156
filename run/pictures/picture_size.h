// How large a picture may be.
#pragma once

#include "core/result.h"
#include "lang/program/program.h"
#include "run/script/picture_request.h"

#include <cstdint>

namespace cascade {

/// The size of pictures of a domain. Those of models, surfaces and `has_cells`, of cells that
/// crawl, are drawn from a place in space, and have a size of their own.
PictureSize picture_size(const DomainSettings& domain, const PictureRequest& picture,
                         bool has_cells = false);

/// Refuses pictures of more than 2²⁸ pixels, and those that do not fit into memory; `memory` is
/// what the run needs without them, in bytes, and 0 no limit.
Result<void> check_picture_size(const DomainSettings& domain, const PictureRequest& picture,
                                double memory = 0, std::uint64_t memory_limit = 0);

}  // namespace cascade
