// From an object file to an image, by JITLink, the linker of LLVM's ORC.
//
// Internal to jit/.
#pragma once

#include "core/result.h"
#include "jit/code_image.h"

#include <string_view>

namespace cascade {

/// Links an object file, of x86-64 or AArch64, to an image of its function `name` and of what that
/// refers to. Fails where the object has no such function, refers to what is not in it, or would
/// need other bytes at another address. The object must be one that LLVM wrote in this process:
/// JITLink trusts it.
Result<CodeImage> link_image(std::string_view object, std::string_view name);

}  // namespace cascade
