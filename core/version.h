// The version of Cascade.
#pragma once

#include <string_view>

namespace cascade {

/// The version that `--version` prints and that pictures and saved runs record, such as "0.9.0".
std::string_view version();

}  // namespace cascade
