// Bytes of a source that are not valid text (internal to the lexer).
#pragma once

#include "core/diagnostics.h"
#include "core/source.h"

#include <cstddef>
#include <string_view>

namespace cascade {

/// True if no character begins at `offset`: a NUL byte, or bytes that are not UTF-8.
bool is_unreadable(std::string_view text, std::size_t offset);

/// Reports each run of NUL bytes and of bytes that are not UTF-8, even in comments.
void report_unreadable_bytes(SourceId source, std::string_view text, Diagnostics& diagnostics);

}  // namespace cascade
