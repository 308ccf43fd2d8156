// Serves one editor over two streams.
#pragma once

#include "core/result.h"

namespace cascade::lsp {

/// Reads messages from the file descriptor `in` and writes the answers to `out`, until the editor
/// sends `exit` or closes its stream. Diagnostics are sent whenever no further message waits, so
/// that not every letter of a fast writer is checked. The result is whether the editor has sent
/// `shutdown` before. Fails if the input is no stream of messages, or if a stream fails.
Result<bool> serve(int in, int out);

}  // namespace cascade::lsp
