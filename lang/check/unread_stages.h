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
    /// The stage to which names in the formula refer. The picture reads this stage, even if the
    /// formula reads nothing else.
    std::uint32_t stage = 0;
    std::optional<Formula> formula;
};

/// Warns of every stage that neither a later stage nor a picture reads.
void warn_of_unread_stages(const Program& program, std::span<const PictureView> views,
                           Diagnostics& diagnostics);

}  // namespace cascade
