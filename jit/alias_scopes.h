// Metadata that tells LLVM which accesses to memory cannot overlap.
//
// Internal to jit/. Results overlap neither each other nor inputs that are read at neighbours. An
// input that is read only in the cell itself may also be a result, so accesses to such an input are
// not marked. Pointers to planes are loaded from tables, so attributes of arguments cannot express
// this.
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

    /// Marks an access to an input that is read at neighbours (plane 0), or to result k (plane k +
    /// 1).
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
