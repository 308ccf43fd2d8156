// Builds the keys of compiled kernels.
#include "jit/kernel_key.h"

#include "jit/generator.h"
#include "jit/processor.h"

#include <fmt/format.h>

#include <initializer_list>

namespace cascade {

std::string kernel_key(const CellKernel& kernel, const KernelShape& shape) {
    std::string key;
    const auto add = [&](std::initializer_list<std::uint64_t> words) {
        for (const std::uint64_t word : words) {
            key.append(reinterpret_cast<const char*>(&word), sizeof word);
        }
    };
    add({shape.stencil.number(), static_cast<std::uint64_t>(shape.lanes),
         static_cast<std::uint64_t>(kernel.precision), kernel.field_names.size(),
         kernel.mask_names.size(), kernel.uniform_names.size(), kernel.code.size(),
         kernel.results.size()});
    for (const Instruction& instruction : kernel.code) {
        const auto& [a, b, c] = instruction.operands;
        add({static_cast<std::uint64_t>(instruction.op) << 32 | a.index(),
             std::uint64_t{b.index()} << 32 | c.index(), instruction.payload});
    }
    for (const ValueId result : kernel.results) add({result.index()});
    return key;
}

std::string environment_key(int optimise) {
    const std::string llvm = llvm_identity();
    const std::string processor = host_identity();
    if (llvm.empty() || processor.empty()) return {};
    return fmt::format("{}|{}|{}|{}|", code_version(), llvm, optimise, processor);
}

}  // namespace cascade
