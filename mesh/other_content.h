// Recognises files whose content does not agree with their name.
#pragma once

#include "core/result.h"

#include <optional>
#include <string_view>

namespace cascade {

/// Names the content of a file if its first bytes show that it is not a model of its extension: an
/// empty file, an archive, a page of HTML, a pointer of Git LFS, or a model in another format.
/// `ending` is the extension in lower case. nullopt if the content may agree with the extension.
std::optional<Failure> other_content(std::string_view bytes, std::string_view ending);

}  // namespace cascade
