// Turns an object file into an image by JITLink, the linker of LLVM's ORC.
//
// Internal to jit/.
#pragma once

#include "core/result.h"
#include "jit/code_image.h"

#include <string_view>

namespace cascade {

/// Links an object file for x86-64 or AArch64 to an image of its function `name` and the code that
/// this function uses. Fails if the object lacks the function, if the object refers to symbols of
/// other objects, or if the image's bytes would depend on the address at which it is loaded. LLVM
/// must have written the object in this process, because JITLink does not check its input.
Result<CodeImage> link_image(std::string_view object, std::string_view name);

}  // namespace cascade
