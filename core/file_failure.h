// Messages for failed system calls on files (internal to core/).
#pragma once

#include "core/printable.h"
#include "core/result.h"

#include <fmt/format.h>

#include <cerrno>
#include <string_view>
#include <system_error>

namespace cascade {

/// A failure with the system's words for an error number: "cannot read 'NAME': No such file or
/// directory".
inline tl::unexpected<Failure> cannot(std::string_view verb, std::string_view name, int error) {
    std::string hint;
    if (error == ENOSPC || error == EDQUOT) hint = "free some space and run it again";
    return failure(fmt::format("cannot {} '{}': {}", verb, short_name(name),
                               std::generic_category().message(error)),
                   std::move(hint));
}

}  // namespace cascade
