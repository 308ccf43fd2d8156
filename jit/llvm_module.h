// The functions of the code generator's module, implemented with LLVM.
//
// Internal to jit/. jit/generator.h documents them.
#pragma once

#include "jit/generator.h"

namespace cascade::llvm_module {

Result<CodeImage> compile(const CellKernel& kernel, const KernelShape& shape, int optimise);
Result<std::string> dump_llvm(const CellKernel& kernel, Stencil stencil, const JitOptions& options);
Result<std::string> dump_assembly(const CellKernel& kernel, Stencil stencil,
                                  const JitOptions& options);
Result<std::vector<std::uint8_t>> compile_object(const ObjectContent& content, Stencil stencil,
                                                 const std::string& cpu);
std::vector<std::string> known_targets();

}  // namespace cascade::llvm_module
