// The backend of a tab: kernels as WebAssembly modules (wasm/kernel_module.h), which the browser
// compiles and puts into the engine's table of functions.
#pragma once

#include "ir/backend.h"

#include <memory>

namespace cascade {

std::unique_ptr<Backend> make_module_backend();

}  // namespace cascade
