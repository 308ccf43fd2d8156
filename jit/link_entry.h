// Writes the code that reads one entry of a slice of links (core/links.h) for a vector of cells,
// and the code that copies the fields that entries read.
//
// Internal to jit/. Offsets, weights and the fields' values at the targets are loaded once, however
// often they are used.
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

/// Identifies a sum over links by its operation and payload.
using SumKey = std::pair<Op, std::uint64_t>;
inline SumKey key_of(const Instruction& instruction) {
    return {instruction.op, instruction.payload};
}

/// The positions of the extra arguments: the arrays of a LinkTable, followed by the arguments for
/// pairs of fields.
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

/// Copies of pairs of fields, in which the numbers of both fields are side by side.
class PairedFields {
public:
    /// Writes the loop that makes the copies. `builder` continues after that loop.
    PairedFields(KernelFrame& frame, Builder& builder);

    /// The index of the pair that contains this field, if any.
    std::optional<std::size_t> with(FieldSlot slot) const;
    const FieldPair& slots(std::size_t pair) const { return pairs_[pair]; }
    bool empty() const { return pairs_.empty(); }
    /// The address of both numbers of an element.
    llvm::Value* address(Builder& builder, std::size_t pair, llvm::Value* element) const {
        llvm::Value* number = builder.CreateSub(element, first_);
        return builder.CreateInBoundsGEP(both(builder), copies_[pair], number);
    }
    /// The LLVM type with which both numbers of a cell are loaded or gathered at once.
    static llvm::Type* both(Builder& builder) { return builder.getDoubleTy(); }

private:
    std::vector<FieldPair> pairs_;
    llvm::Value* first_;
    std::vector<llvm::Value*> copies_;  ///< The copy of each pair.
};

/// The data of one entry of a slice for a vector of cells, as LLVM values.
class LinkEntry final : public Sources {
public:
    /// `link` is the index of the vector's first link. The fields' values in the cells themselves
    /// are taken from `cells`, whose code is outside the loop over entries.
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

    /// The term that the entry adds to a sum.
    llvm::Value* term(SumKey sum);
    llvm::Value* theirs(FieldSlot slot) override { return at_targets(slot); }
    /// <N x i1>: whether each lane has a link, or only padding.
    llvm::Value* is_link();
    /// Prefetches the offsets and weights of later entries.
    void prefetch_ahead();

private:
    /// The difference f_j − f_i of a field's values at the target and in the cell.
    llvm::Value* difference(FieldSlot slot);
    llvm::Value* at_targets(FieldSlot slot);
    void fetch_pair(std::size_t pair);
    llvm::Value* gathered(llvm::Type* element, llvm::Value* base);
    llvm::Value* loaded(llvm::Type* element, llvm::Value* base, llvm::ArrayRef<int> lanes);
    void load_offsets();
    llvm::Value* base();
    /// The address of this entry's element in an array with one element per entry.
    llvm::Value* address_of_entry(unsigned array, llvm::Type* element);
    llvm::Value* numbers(unsigned array);
    /// The numbers of a field that has one number per link.
    llvm::Value* numbers_of(FieldSlot slot);
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
    std::vector<int> lanes_;  ///< The numbers 0, 1, 2, ….
    bool gathers_;  ///< Whether targets are read by gather instructions, one or two per vector.
    std::map<unsigned, llvm::Value*> numbers_;  ///< The vector loaded from each array.
    /// The values at the targets, and their differences from the cells' own values, by slot.
    std::map<FieldSlot, llvm::Value*> fields_, differences_;
    /// The numbers of the links, by slot.
    std::map<FieldSlot, llvm::Value*> of_links_;
    llvm::Value *base_ = nullptr, *is_link_ = nullptr;
    /// One for each lane, or if targets are gathered, one vector for all lanes.
    std::vector<llvm::Value*> offsets_;
};

}  // namespace cascade
