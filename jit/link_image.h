// Turns an object file into an image, by JITLink, the linker of LLVM's ORC.
//
// Internal to jit/.
#pragma once

#include "core/result.h"
#include "jit/code_image.h"

#include <string_view>

namespace cascade {

/// Links an object file, for x86-64 or AArch64, to an image of its function `name` and the code it
/// uses. Fails if the object lacks the function, refers to symbols outside, or would need other
/// bytes at another address. LLVM must have written the object in this process, because JITLink
/// trusts it.
Result<CodeImage> link_image(std::string_view object, std::string_view name);

}  // namespace cascade
