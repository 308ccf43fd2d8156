// The backend of a browser's tab. Kernels are WebAssembly modules (wasm/kernel_module.h), which the
// browser compiles and adds to the engine's table of functions.
#pragma once

#include "ir/backend.h"

#include <memory>

namespace cascade {

/// Modules made after this call flush denormal numbers wherever the native program does
/// (WasmOptions::is_exact).
void make_modules_exact();

std::unique_ptr<Backend> make_module_backend();
/// A backend whose modules flush denormal numbers even if make_modules_exact() was not called.
std::unique_ptr<Backend> make_exact_backend();

/// A backend for kernels that run once. This is the interpreter or, after make_modules_exact(), a
/// backend that makes modules, because in a tab the interpreter flushes only results.
std::unique_ptr<Backend> make_starting_backend();

}  // namespace cascade
