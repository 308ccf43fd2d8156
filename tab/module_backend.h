// The backend of a tab: kernels as WebAssembly modules (wasm/kernel_module.h), which the browser
// compiles and adds to the engine's table of functions.
#pragma once

#include "ir/backend.h"

#include <memory>

namespace cascade {

/// From now on modules flush denormal numbers wherever the program does (WasmOptions::is_exact).
void make_modules_exact();

std::unique_ptr<Backend> make_module_backend();

/// For kernels that run once: the interpreter or, because it flushes results only, exact modules.
std::unique_ptr<Backend> make_starting_backend();

}  // namespace cascade
