// Serves one editor over two streams.
#pragma once

#include "core/result.h"

namespace cascade::lsp {

/// Reads messages from the file descriptor `in` and writes the answers to `out`, until the editor
/// sends `exit` or closes its stream. Diagnostics are sent only when no further message is waiting,
/// so that a script is not checked after every letter while a user types fast. Returns whether the
/// editor has sent `shutdown` before. Fails if the input is not a stream of messages, or if a
/// stream fails.
Result<bool> serve(int in, int out);

}  // namespace cascade::lsp
