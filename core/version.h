// The version of Cascade.
#pragma once

#include <string_view>

namespace cascade {

/// The version that pictures and saved runs carry and that `--version` prints, such as "0.1.0".
std::string_view version();

}  // namespace cascade
