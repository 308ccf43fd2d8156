// The public functions of jit/ in a build without LLVM.
#include "jit/jit.h"

namespace cascade {
namespace {

auto none(std::string hint = {}) {
    return failure("this build has no native compiler", std::move(hint));
}

}  // namespace

bool has_jit() { return false; }
std::string describe_jit() { return "LLVM, which this build is without"; }

Result<std::unique_ptr<Backend>> make_jit(const JitOptions&) {
    return none("use --backend interp");
}

Result<std::string> dump_llvm(const CellKernel&, Stencil, const JitOptions&) {
    return none("tokens, ast, program, graph, plan and ir can be shown");
}

Result<std::string> dump_assembly(const CellKernel& kernel, Stencil stencil,
                                  const JitOptions& options) {
    return dump_llvm(kernel, stencil, options);
}

Result<std::vector<std::uint8_t>> compile_object(const ObjectContent&, Stencil,
                                                 const std::string&) {
    return none();
}

}  // namespace cascade
