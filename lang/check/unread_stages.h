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
    std::uint32_t stage = 0;  ///< Whose names it reads; it counts as read.
    std::optional<Formula> formula;
};

/// Warns of every stage that nothing reads. A stage that reads nothing is not reported if it is
/// read itself.
void warn_of_unread_stages(const Program& program, std::span<const PictureView> views,
                           Diagnostics& diagnostics);

}  // namespace cascade
