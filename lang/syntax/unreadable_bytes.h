// Finds bytes of a source that are not valid text (internal to the lexer).
#pragma once

#include "core/diagnostics.h"
#include "core/source.h"

#include <cstddef>
#include <string_view>

namespace cascade {

/// Whether there is a NUL byte, or bytes that are not UTF-8, at `offset`.
bool is_unreadable(std::string_view text, std::size_t offset);

/// Reports each run of NUL bytes and each run of bytes that are not UTF-8, in comments, too.
void report_unreadable_bytes(SourceId source, std::string_view text, Diagnostics& diagnostics);

}  // namespace cascade
