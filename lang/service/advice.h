// What hints tell to write.
#pragma once

#include <string_view>

namespace cascade {

/// The text that a hint tells to write where its message underlines: x of "write 'x' to multiply"
/// and of "did you mean 'x'?", else all after "write ". Empty if there is none. It may leave
/// something open ("…").
std::string_view text_to_write(std::string_view hint);

}  // namespace cascade
