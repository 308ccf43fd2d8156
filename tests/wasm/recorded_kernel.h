// A kernel that records its inputs and results, with a WebAssembly module that must compute the
// same results: a case for tests/wasm/run_cases.mjs. A case consists of:
//
// - its name and the bytes of the module;
// - the memory before the calls, beginning at address 0;
// - the number of calls, and the list of arguments of each;
// - the bytes of a number, the number of results, and for each its address, the list of bytes at
//   this address after the calls, and a list with 1 for each number that may be anything.
#pragma once

#include "ir/backend.h"
#include "tests/support/case_file.h"

#include <string>

namespace cascade::test {

/// How a kernel is recorded.
struct Recording {
    std::string name;
    bool is_exact = false;
    bool is_in_place = false;  ///< Whether results overwrite fields where this is allowed.
};

/// Makes a kernel that the interpreter runs. Each run adds a case to the file, which must outlive
/// the kernel.
KernelPointer recorded_kernel(const CellKernel& kernel, Stencil stencil, const Recording& recording,
                              CaseFile& file);

}  // namespace cascade::test
