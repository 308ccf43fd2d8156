// Finds the replacement that a hint suggests, and checks it.
#pragma once

#include "core/diagnostics.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace cascade {

/// The text that a hint suggests in place of the underlined text: x in "write 'x' to multiply" and
/// in "did you mean 'x'?", else everything after "write ". Empty if the hint suggests no text. The
/// text may contain "…" where the user has to complete it.
std::string_view text_to_write(std::string_view hint);

/// The text to write in place of the underlined text of a diagnostic, as the hint of the diagnostic
/// suggests. Empty unless the replacement removes the diagnostic and causes no other. `text` is the
/// text of the diagnostic's source, and `before` are all diagnostics of this source. `check`
/// returns the diagnostics of a changed text.
std::optional<std::string> fix_of(const Diagnostic& diagnostic, const std::string& text,
                                  const Diagnostics& before,
                                  const std::function<Diagnostics(const std::string&)>& check);

}  // namespace cascade
