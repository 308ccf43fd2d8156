// Spellings that are not in a source as they stand.
#pragma once

#include <string>
#include <string_view>

namespace cascade {

/// A copy of the text that lives as long as the process; equal texts share one. Any thread may call
/// it.
std::string_view kept_spelling(const std::string& text);

}  // namespace cascade
