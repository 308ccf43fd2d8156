// Reports requests for sources at the wrong loop level, which are bugs.
#include "jit/kernel_sources.h"

#include "core/check.h"

namespace cascade {
namespace {

llvm::Value* not_here() {
    CHECK(false, "sources are asked for values of their own loop level");
    return nullptr;
}

}  // namespace

llvm::Value* Sources::uniform(UniformSlot) { return not_here(); }
llvm::Value* Sources::hidden(std::uint64_t) { return not_here(); }
llvm::Value* Sources::cell_row() { return not_here(); }
llvm::Value* Sources::cell_slice() { return not_here(); }
llvm::Value* Sources::field(FieldSlot) { return not_here(); }
llvm::Value* Sources::laplacian(FieldSlot) { return not_here(); }
llvm::Value* Sources::neighbour(Neighbour) { return not_here(); }
llvm::Value* Sources::link_sum(const Instruction&) { return not_here(); }
llvm::Value* Sources::mask(MaskSlot) { return not_here(); }
llvm::Value* Sources::cell_column() { return not_here(); }
llvm::Value* Sources::theirs(FieldSlot) { return not_here(); }

}  // namespace cascade
