// One entry of a slice of links for a vector of cells, and the copies of fields that it reads.
//
// Internal to jit/. Offsets and weights are loaded once, and a field's values at the targets are
// read once, for any number of uses.
#pragma once

#include "core/links.h"
#include "jit/field_pairs.h"
#include "jit/skeleton.h"

#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace cascade {

/// Identifies a sum of a kernel.
using SumKey = std::pair<Op, std::uint64_t>;
inline SumKey key_of(const Instruction& instruction) {
    return {instruction.op, instruction.payload};
}

/// The positions of a LinkTable's arrays among the extra arguments, and what pairs need.
struct LinkArgument {
    enum Number : unsigned {
        starts,
        bases,
        offsets,
        weights,
        gradient_x,
        gradient_y,
        gradient_z,
        filled,
        pair_scratch,
        first_of_pairs,
        end_of_pairs,
        count
    };
};

inline constexpr auto links_of_entry = static_cast<std::uint64_t>(LinkTable<float>::slice_cells);

/// Copies of fields whose numbers are side by side.
class PairedFields {
public:
    /// Writes the loop that makes the copies, and continues after it.
    PairedFields(KernelFrame& frame, Builder& builder);

    /// The pair with this field, if any.
    std::optional<std::size_t> with(FieldSlot slot) const;
    const FieldPair& slots(std::size_t pair) const { return pairs_[pair]; }
    bool empty() const { return pairs_.empty(); }
    /// The address of both numbers of an element.
    llvm::Value* address(Builder& builder, std::size_t pair, llvm::Value* element) const {
        llvm::Value* number = builder.CreateSub(element, first_);
        return builder.CreateInBoundsGEP(both(builder), copies_[pair], number);
    }
    /// Both numbers of a cell, as loads and gathers take them.
    static llvm::Type* both(Builder& builder) { return builder.getDoubleTy(); }

private:
    std::vector<FieldPair> pairs_;
    llvm::Value* first_;
    std::vector<llvm::Value*> copies_;  ///< By pair.
};

/// The content of one entry of a slice for a vector of cells.
class LinkEntry final : public Sources {
public:
    /// `link` is the number of the vector's first link. Own values of `cells` are loaded where
    /// these write.
    LinkEntry(KernelFrame& frame, Builder& builder, llvm::Value* link, CellSources& cells,
              const PairedFields& paired)
        : frame_(frame),
          builder_(builder),
          link_(link),
          cells_(cells),
          paired_(paired),
          lanes_(static_cast<std::size_t>(frame.lanes())),
          gathers_(frame.shape().has_fast_gathers && (paired.empty() || frame.lanes() == 16)) {
        std::iota(lanes_.begin(), lanes_.end(), 0);
    }

    /// The entry's term in a sum.
    llvm::Value* term(SumKey sum);
    llvm::Value* theirs(FieldSlot slot) override { return at_targets(slot); }
    /// <N x i1>: whether a lane has a link instead of padding.
    llvm::Value* is_link();
    /// Prefetches offsets and weights of later entries.
    void prefetch_ahead();

private:
    /// f_j − f_i.
    llvm::Value* difference(FieldSlot slot);
    llvm::Value* at_targets(FieldSlot slot);
    void fetch_pair(std::size_t pair);
    llvm::Value* gathered(llvm::Type* element, llvm::Value* base);
    llvm::Value* loaded(llvm::Type* element, llvm::Value* base, llvm::ArrayRef<int> lanes);
    void load_offsets();
    llvm::Value* base();
    /// The address of an array's element for each entry.
    llvm::Value* address_of_entry(unsigned array, llvm::Type* element);
    llvm::Value* numbers(unsigned array);
    template <typename Load>
    Load* mark(Load* load) {
        return frame_.aliases().mark(load, 0);
    }
    llvm::Value* address(unsigned array, llvm::Type* element, int lane = 0) {
        llvm::Value* link = builder_.CreateAdd(link_, builder_.getInt64(lane));
        return builder_.CreateInBoundsGEP(element, frame_.extra_argument(array), link);
    }

    KernelFrame& frame_;
    Builder& builder_;
    llvm::Value* link_;
    CellSources& cells_;
    const PairedFields& paired_;
    std::vector<int> lanes_;                    ///< In order.
    bool gathers_;                              ///< Uses vectors, by one instruction or two.
    std::map<unsigned, llvm::Value*> numbers_;  ///< By array.
    std::map<FieldSlot, llvm::Value*> fields_, differences_;  ///< By slot.
    llvm::Value *base_ = nullptr, *is_link_ = nullptr;
    std::vector<llvm::Value*> offsets_;  ///< By lane, or one vector of all lanes if gathered.
};

}  // namespace cascade
