// Warnings about stages that neither a later stage nor a picture reads.
#pragma once

#include "core/diagnostics.h"
#include "lang/program/program.h"

#include <cstdint>
#include <optional>
#include <span>

namespace cascade {

/// A formula of the picture.
struct PictureView {
    std::uint32_t stage = 0;  ///< The stage to which names in the formula refer. This stage counts
                              ///< as read.
    std::optional<Formula> formula;
};

/// Warns of every stage that neither a later stage nor a picture reads.
void warn_of_unread_stages(const Program& program, std::span<const PictureView> views,
                           Diagnostics& diagnostics);

}  // namespace cascade
