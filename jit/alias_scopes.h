// Metadata that tells LLVM which accesses cannot overlap.
//
// Internal to jit/. Results overlap neither each other nor inputs that are read at neighbours. An
// input that is only read in the cell itself may be a result, too, so its accesses are not marked.
// Pointers to planes come from tables, so no attribute of an argument can tell LLVM this.
#pragma once

#include <llvm/IR/LLVMContext.h>
#include <llvm/IR/MDBuilder.h>
#include <llvm/IR/Metadata.h>

#include <cstddef>
#include <vector>

namespace cascade {

class AliasScopes {
public:
    AliasScopes(llvm::LLVMContext& context, std::size_t result_count) {
        llvm::MDBuilder metadata(context);
        llvm::MDNode* domain = metadata.createAnonymousAliasScopeDomain("planes");
        std::vector<llvm::Metadata*> scopes;
        for (std::size_t k = 0; k <= result_count; ++k) {
            scopes.push_back(metadata.createAnonymousAliasScope(domain));
        }
        for (std::size_t k = 0; k <= result_count; ++k) {
            own_.push_back(llvm::MDNode::get(context, {scopes[k]}));
            std::vector<llvm::Metadata*> others = scopes;
            others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
            others_.push_back(llvm::MDNode::get(context, others));
        }
    }

    /// Marks an access to an input (plane 0) or to result k (plane k + 1).
    template <typename Access>
    Access* mark(Access* access, std::size_t plane) const {
        access->setMetadata(llvm::LLVMContext::MD_alias_scope, own_[plane]);
        access->setMetadata(llvm::LLVMContext::MD_noalias, others_[plane]);
        return access;
    }

private:
    std::vector<llvm::MDNode*> own_, others_;
};

}  // namespace cascade
