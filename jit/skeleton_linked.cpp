// The loops over links.
//
// For each vector of cells, one loop over the entries of its slice computes all sums of the kernel.
// Reductions have further loops (CellSchedule in ir/loop_levels.h).
#include "jit/skeleton_linked.h"

#include "jit/link_entry.h"

#include <limits>
#include <map>
#include <vector>

namespace cascade {
namespace {

using llvm::Value;

/// Writes the code of one entry with `inner`. Takes the totals before the entry, and returns the
/// totals after it.
using WriteEntry = llvm::function_ref<std::vector<Value*>(LinkEntry& entry, Builder& inner,
                                                          llvm::ArrayRef<Value*> totals)>;

/// The values that linked cells read.
class LinkedSources final : public CellSources {
public:
    LinkedSources(KernelFrame& frame, Builder& builder, const CellVector& vector,
                  const PairedFields& paired)
        : CellSources(frame, builder, vector), paired_(paired) {
        for (const Instruction& instruction : frame.kernel().code) {
            if (is_link_sum(instruction.op)) sums_.emplace(key_of(instruction), nullptr);
        }
        if (!sums_.empty()) add_up();
    }

    Value* laplacian(FieldSlot slot) override { return sums_.at({Op::laplacian, slot.index()}); }
    Value* link_sum(const Instruction& sum) override { return sums_.at(key_of(sum)); }
    void reduce_links(BodyScope& cells, const LinkLoop& loop) override;

private:
    void add_up();
    void find_links();
    Value* start_of(Value* slice);
    Value* without_minus(Value* sum);
    std::vector<Value*> over_entries(llvm::ArrayRef<llvm::Constant*> first, WriteEntry write);
    /// A vector that has a number in all lanes.
    llvm::Constant* number(double value) const {
        return llvm::ConstantFP::get(frame_.vector_of(frame_.number()), value);
    }

    const PairedFields& paired_;
    std::map<SumKey, Value*> sums_;
    Value *first_ = nullptr, *end_ = nullptr;  ///< Indices of links.
};

/// The index of the first link of a slice.
Value* LinkedSources::start_of(Value* slice) {
    llvm::Type* index = builder_.getInt32Ty();
    Value* address =
        builder_.CreateInBoundsGEP(index, frame_.extra_argument(LinkArgument::starts), slice);
    llvm::LoadInst* entry =
        frame_.aliases().mark(builder_.CreateAlignedLoad(index, address, alignment(4)), 0);
    return builder_.CreateMul(builder_.CreateZExt(entry, builder_.getInt64Ty()),
                              builder_.getInt64(links_of_entry));
}

/// Writes the code that finds the links of the vector. Only the first call has an effect.
void LinkedSources::find_links() {
    if (first_) return;
    const auto count = [&](std::uint64_t number) { return builder_.getInt64(number); };
    // The stride is the width of all slices of a row, plus one slice of padding on each side.
    Value* slices =
        builder_.CreateSub(builder_.CreateUDiv(frame_.stride(), count(links_of_entry)), count(2));
    Value* column = builder_.CreateSub(element_, vector_.row_start);
    Value* slice = builder_.CreateAdd(builder_.CreateMul(vector_.row, slices),
                                      builder_.CreateUDiv(column, count(links_of_entry)));
    Value* lane = builder_.CreateAnd(column, count(links_of_entry - 1));
    first_ = builder_.CreateAdd(start_of(slice), lane);
    end_ = start_of(builder_.CreateAdd(slice, count(1)));
}

// A slice may have no entries. While the loop is written, code for the values that its entries need
// from the vector's own cells is added to the block before the loop. So that block gets its
// terminator last. Until the loop is complete, loads take the place of the loop's phi nodes,
// because InstSimplifyFolder draws wrong conclusions from unfinished phi nodes.
std::vector<Value*> LinkedSources::over_entries(llvm::ArrayRef<llvm::Constant*> first,
                                                WriteEntry write) {
    find_links();
    llvm::BasicBlock* before = builder_.GetInsertBlock();
    llvm::BasicBlock* entries = frame_.new_block("entries");
    llvm::BasicBlock* after = frame_.new_block("entries_done");
    Builder inner(entries, frame_.folder());
    const auto stand_in = [&](llvm::Type* type) {
        return inner.CreateLoad(type, frame_.function().getArg(0));
    };
    llvm::LoadInst* const link = stand_in(inner.getInt64Ty());
    std::vector<Value*> totals;
    for (llvm::Constant* each : first) totals.push_back(stand_in(each->getType()));
    LinkEntry entry(frame_, inner, link, *this, paired_);
    const std::vector<Value*> next = write(entry, inner, totals);
    entry.prefetch_ahead();
    Value* next_link = inner.CreateAdd(link, inner.getInt64(links_of_entry));
    inner.CreateCondBr(inner.CreateICmpULT(next_link, end_), entries, after);
    builder_.CreateCondBr(builder_.CreateICmpULT(first_, end_), entries, after);
    const auto phi = [&](Value* at_first, Value* later) {
        llvm::PHINode* node = builder_.CreatePHI(later->getType(), 2);
        node->addIncoming(at_first, before);
        node->addIncoming(later, entries);
        return node;
    };
    const auto replace = [&](Value* load, Value* at_first, Value* later) {
        builder_.SetInsertPoint(entries, entries->begin());
        llvm::PHINode* node = phi(at_first, later);
        load->replaceAllUsesWith(node);
        llvm::cast<llvm::Instruction>(load)->eraseFromParent();
        // `later` may have been the replaced load, so it is read from the node.
        return node->getIncomingValue(1);
    };
    replace(link, first_, next_link);
    std::vector<Value*> results;
    for (std::size_t k = 0; k < totals.size(); ++k) {
        results.push_back(replace(totals[k], first[k], next[k]));
    }
    builder_.SetInsertPoint(after);
    for (std::size_t k = 0; k < totals.size(); ++k) results[k] = phi(first[k], results[k]);
    return results;
}

void LinkedSources::add_up() {
    const std::vector<llvm::Constant*> zeros(sums_.size(), number(0));
    const auto write = [&](LinkEntry& entry, Builder& inner, llvm::ArrayRef<Value*> totals) {
        std::vector<Value*> next;
        for (const auto& [key, value] : sums_) {
            next.push_back(inner.CreateFAdd(totals[next.size()], entry.term(key)));
        }
        return next;
    };
    const std::vector<Value*> totals = over_entries(zeros, write);
    std::size_t k = 0;
    for (auto& [key, value] : sums_) value = totals[k++];
}

// Turns −0 into 0 by integer operations. LLVM assumes that a sum beginning with 0 is never −0, but
// a flushed sum may be −0.
Value* LinkedSources::without_minus(Value* sum) {
    llvm::Type* words = frame_.vector_of(frame_.word());
    Value* const bits = builder_.CreateBitCast(sum, words);
    Value* const is_minus_zero = builder_.CreateICmpEQ(
        bits, llvm::ConstantInt::get(words, format_of(frame_.kernel().precision).sign()));
    return builder_.CreateBitCast(builder_.CreateSelect(is_minus_zero,
                                                        llvm::Constant::getNullValue(words), bits),
                                  sum->getType());
}

void LinkedSources::reduce_links(BodyScope& cells, const LinkLoop& loop) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto instruction = [&](ValueId id) { return frame_.kernel().code[id]; };
    std::vector<llvm::Constant*> first;
    for (const ValueId id : loop.reductions) {
        const Op op = instruction(id).op;
        first.push_back(number(op == Op::link_sum     ? 0
                               : op == Op::link_least ? infinity
                                                      : -infinity));
    }
    const auto write = [&](LinkEntry& entry, Builder& inner, llvm::ArrayRef<Value*> totals) {
        BodyScope links(cells.body(), LoopLevel::link, inner, entry, &cells);
        emit_values(links, loop.values);
        std::vector<Value*> next;
        for (const ValueId id : loop.reductions) {
            const auto [op, operands, payload] = instruction(id);
            Value* const before = totals[next.size()];
            // A lane without a link adds the initial value, which changes no total.
            Value* const a = inner.CreateSelect(entry.is_link(), links.flushed_number(operands[0]),
                                                first[next.size()]);
            if (op == Op::link_sum) {
                next.push_back(inner.CreateFAdd(before, a));
                continue;
            }
            Value* const is_farther = op == Op::link_least ? inner.CreateFCmpOLT(before, a)
                                                           : inner.CreateFCmpOGT(before, a);
            Value* const farther = inner.CreateSelect(is_farther, before, a);
            next.push_back(
                inner.CreateSelect(inner.CreateFCmpUNO(before, before), before, farther));
        }
        return next;
    };
    const std::vector<Value*> totals = over_entries(first, write);
    for (std::size_t k = 0; k < totals.size(); ++k) {
        const bool is_sum = instruction(loop.reductions[k]).op == Op::link_sum;
        Forms total;
        total.number = is_sum ? without_minus(totals[k]) : totals[k];
        cells.define(loop.reductions[k], total);
    }
}

}  // namespace

llvm::Function* build_linked_function(llvm::Module& module, const KernelPart& part,
                                      const KernelShape& shape, const std::string& name) {
    std::vector<llvm::Type*> extra(LinkArgument::count,
                                   llvm::PointerType::getUnqual(module.getContext()));
    extra[LinkArgument::first_of_pairs] = extra[LinkArgument::end_of_pairs] =
        llvm::Type::getInt64Ty(module.getContext());
    return build_function(module, part, shape, name, extra,
                          [](KernelFrame& frame, KernelLoops& loops, Builder& builder) {
                              const PairedFields paired(frame, builder);
                              loops.rows(builder, frame.row_begin(), 1,
                                         [&](llvm::ArrayRef<CellVector> row, Builder& inner) {
                                             LinkedSources cells(frame, inner, row[0], paired);
                                             loops.body(cells, inner, row[0]);
                                         });
                              builder.CreateRetVoid();
                          });
}

}  // namespace cascade
