// Sums over links.
//
// For each vector of cells one loop over the entries of its slice computes all sums of the kernel
// together: targets and weights are loaded once, and what a field holds at the targets is read
// once, however many sums ask for it.
#include "jit/skeleton_linked.h"

#include "core/links.h"
#include "jit/skeleton.h"

#include <map>
#include <utility>
#include <vector>

namespace cascade {
namespace {

using llvm::Value;

/// A sum of a kernel, by what tells it from others.
using SumKey = std::pair<Op, std::uint64_t>;
SumKey key_of(const Instruction& instruction) { return {instruction.op, instruction.payload}; }

/// Where the arrays of a LinkTable stand among the extra arguments.
enum Array : unsigned { starts, targets, weights, gradient_x, gradient_y, gradient_z, array_count };

/// What a sum multiplies the differences by.
Array weights_of(Op op) {
    switch (op) {
        case Op::gradient_x: return gradient_x;
        case Op::gradient_y: return gradient_y;
        case Op::gradient_z: return gradient_z;
        default: return weights;
    }
}

constexpr auto slice_cells = static_cast<std::uint64_t>(LinkTable<float>::slice_cells);

/// What one entry of a slice holds for a vector of cells.
class LinkEntry {
public:
    /// `link` is the number of the vector's first link; `cells` have loaded their own values.
    LinkEntry(KernelFrame& frame, Builder& builder, Value* link, CellSources& cells)
        : frame_(frame), builder_(builder), link_(link), cells_(cells) {}

    /// What it adds to a sum.
    Value* term(SumKey sum);
    /// Asks for targets and weights of later entries.
    void prefetch_ahead();

private:
    /// f_j − f_i.
    Value* difference(FieldSlot slot);
    Value* at_targets(FieldSlot slot);
    void load_targets();
    Value* numbers(unsigned array);
    Value* address(unsigned array, llvm::Type* element, int lane = 0) {
        Value* link = builder_.CreateAdd(link_, builder_.getInt64(lane));
        return builder_.CreateInBoundsGEP(element, frame_.extra_argument(array), link);
    }

    KernelFrame& frame_;
    Builder& builder_;
    Value* link_;
    CellSources& cells_;
    std::map<unsigned, Value*> numbers_;                ///< By array.
    std::map<FieldSlot, Value*> fields_, differences_;  ///< By slot.
    std::vector<Value*> targets_;                       ///< By lane.
};

Value* LinkEntry::term(SumKey sum) {
    const auto [op, payload] = sum;
    const Flow flow = Flow::with(payload);
    Value* change = difference(flow.of);
    if (op == Op::link_squares) change = builder_.CreateFMul(change, change);
    if (op == Op::link_flow) {
        Value* factors = builder_.CreateFAdd(at_targets(flow.factor), cells_.field(flow.factor));
        change = builder_.CreateFMul(factors, change);
    }
    return builder_.CreateFMul(numbers(weights_of(op)), change);
}

Value* LinkEntry::difference(FieldSlot slot) {
    Value*& value = differences_[slot];
    if (!value) value = builder_.CreateFSub(at_targets(slot), cells_.field(slot));
    return value;
}

// Loads of 64 bits hold two targets, since it is loads that bound the loop: on a Zen 4 this takes
// 0.95 of the time of a load for each target, and 0.52 of that of the processor's gathers, which
// are slower with vectors of 8 and 4 cells as well. Targets are not negative.
void LinkEntry::load_targets() {
    const bool low_is_first = frame_.function().getDataLayout().isLittleEndian();
    for (int lane = 0; lane < frame_.lanes(); lane += 2) {
        llvm::LoadInst* load =
            builder_.CreateAlignedLoad(builder_.getInt64Ty(),
                                       address(targets, builder_.getInt32Ty(), lane), alignment(8));
        Value* both = frame_.aliases().mark(load, 0);
        Value* low = builder_.CreateAnd(both, builder_.getInt64(0xffffffff));
        Value* high = builder_.CreateLShr(both, 32);
        targets_.push_back(low_is_first ? low : high);
        targets_.push_back(low_is_first ? high : low);
    }
}

Value* LinkEntry::at_targets(FieldSlot slot) {
    Value*& value = fields_[slot];
    if (value) return value;
    if (targets_.empty()) load_targets();
    value = llvm::PoisonValue::get(frame_.vector_of(frame_.number()));
    for (std::size_t lane = 0; lane < targets_.size(); ++lane) {
        Value* address =
            builder_.CreateInBoundsGEP(frame_.number(), frame_.field_plane(slot), targets_[lane]);
        llvm::LoadInst* load =
            builder_.CreateAlignedLoad(frame_.number(), address, alignment(frame_.number_bytes()));
        value = builder_.CreateInsertElement(value, frame_.aliases().mark(load, 0), lane);
    }
    return value;
}

// Most of what a step reads are links: with prefetches a million cells take 0.91 to 0.96 of the
// time, cells that fit into the cache the same. The addresses may lie beyond the arrays.
void LinkEntry::prefetch_ahead() {
    constexpr int entries = 16;
    const auto prefetch = [&](unsigned array, llvm::Type* element) {
        Value* link =
            builder_.CreateAdd(link_,
                               builder_.getInt64(entries * static_cast<std::int64_t>(slice_cells)));
        frame_.prefetch(builder_, builder_.CreateGEP(element, frame_.extra_argument(array), link));
    };
    prefetch(targets, builder_.getInt32Ty());
    for (const auto& [array, value] : numbers_) prefetch(array, frame_.number());
}

Value* LinkEntry::numbers(unsigned array) {
    Value*& value = numbers_[array];
    if (!value) {
        llvm::LoadInst* load = builder_.CreateAlignedLoad(frame_.vector_of(frame_.number()),
                                                          address(array, frame_.number()),
                                                          alignment(frame_.vector_bytes()));
        value = frame_.aliases().mark(load, 0);
    }
    return value;
}

/// What linked cells read.
class LinkedSources final : public CellSources {
public:
    LinkedSources(KernelFrame& frame, Builder& builder, const CellVector& vector)
        : CellSources(frame, builder, vector) {
        for (const Instruction& instruction : frame.kernel().code) {
            if (is_link_sum(instruction.op)) sums_.emplace(key_of(instruction), nullptr);
        }
        if (!sums_.empty()) add_up();
    }

    Value* laplacian(FieldSlot slot) override { return sums_.at({Op::laplacian, slot.index()}); }
    Value* link_sum(const Instruction& sum) override { return sums_.at(key_of(sum)); }

private:
    void add_up();
    void load_own();
    Value* start_of(Value* slice);

    std::map<SumKey, Value*> sums_;
};

/// Loads what the loop needs of the cells themselves before it.
void LinkedSources::load_own() {
    for (const auto& [key, value] : sums_) {
        const Flow flow = Flow::with(key.second);
        field(flow.of);
        if (key.first == Op::link_flow) field(flow.factor);
    }
}

/// The number of the first link of a slice.
Value* LinkedSources::start_of(Value* slice) {
    llvm::Type* index = builder_.getInt32Ty();
    Value* address = builder_.CreateInBoundsGEP(index, frame_.extra_argument(starts), slice);
    llvm::LoadInst* entry =
        frame_.aliases().mark(builder_.CreateAlignedLoad(index, address, alignment(4)), 0);
    return builder_.CreateMul(builder_.CreateZExt(entry, builder_.getInt64Ty()),
                              builder_.getInt64(slice_cells));
}

/// Writes the loop, and goes on after it. A slice may have no entries.
void LinkedSources::add_up() {
    load_own();
    const auto count = [&](std::uint64_t number) { return builder_.getInt64(number); };
    Value* slices = builder_.CreateUDiv(builder_.CreateAdd(frame_.width(), count(slice_cells - 1)),
                                        count(slice_cells));
    Value* column = builder_.CreateSub(element_, vector_.row_start);
    Value* slice = builder_.CreateAdd(builder_.CreateMul(vector_.row, slices),
                                      builder_.CreateUDiv(column, count(slice_cells)));
    Value* lane = builder_.CreateAnd(column, count(slice_cells - 1));
    Value* first = builder_.CreateAdd(start_of(slice), lane);
    Value* end = start_of(builder_.CreateAdd(slice, count(1)));

    llvm::BasicBlock* before = builder_.GetInsertBlock();
    llvm::BasicBlock* entries = frame_.new_block("entries");
    llvm::BasicBlock* after = frame_.new_block("entries_done");
    builder_.CreateCondBr(builder_.CreateICmpULT(first, end), entries, after);

    builder_.SetInsertPoint(entries);
    llvm::PHINode* link = builder_.CreatePHI(builder_.getInt64Ty(), 2, "link");
    llvm::Type* vector = frame_.vector_of(frame_.number());
    std::map<SumKey, llvm::PHINode*> sums_before;
    for (const auto& [key, value] : sums_) sums_before[key] = builder_.CreatePHI(vector, 2);
    LinkEntry entry(frame_, builder_, link, *this);
    for (auto& [key, value] : sums_) {
        value = builder_.CreateFAdd(sums_before[key], entry.term(key));
    }
    if (frame_.vector_bytes() == cache_line) entry.prefetch_ahead();
    Value* next = builder_.CreateAdd(link, count(slice_cells));
    builder_.CreateCondBr(builder_.CreateICmpULT(next, end), entries, after);
    link->addIncoming(first, before);
    link->addIncoming(next, entries);

    builder_.SetInsertPoint(after);
    llvm::Constant* zero = llvm::ConstantFP::getZero(vector);
    for (auto& [key, value] : sums_) {
        sums_before[key]->addIncoming(zero, before);
        sums_before[key]->addIncoming(value, entries);
        llvm::PHINode* sum = builder_.CreatePHI(vector, 2);
        sum->addIncoming(zero, before);
        sum->addIncoming(value, entries);
        value = sum;
    }
}

}  // namespace

llvm::Function* build_linked_function(llvm::Module& module, const CellKernel& kernel,
                                      const KernelShape& shape, const std::string& name) {
    const std::vector<llvm::Type*> extra(array_count,
                                         llvm::PointerType::getUnqual(module.getContext()));
    return build_function(module, kernel, shape, name, extra,
                          [](KernelFrame& frame, KernelLoops& loops, Builder& builder) {
                              loops.rows(builder, [&](const CellVector& vector, Builder& inner,
                                                      BodyScope& row_scope) {
                                  LinkedSources cells(frame, inner, vector);
                                  loops.body(cells, inner, row_scope);
                              });
                              builder.CreateRetVoid();
                          });
}

}  // namespace cascade
