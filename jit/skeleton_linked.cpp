// Sums over links.
//
// For each vector of cells one loop over the entries of its slice computes all sums of the kernel
// together: offsets and weights are loaded once, and what a field holds at the targets is read
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
enum Array : unsigned {
    starts,
    bases,
    offsets,
    weights,
    gradient_x,
    gradient_y,
    gradient_z,
    array_count
};

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
    /// Asks for offsets and weights of later entries.
    void prefetch_ahead();

private:
    /// f_j − f_i.
    Value* difference(FieldSlot slot);
    Value* at_targets(FieldSlot slot);
    Value* gathered(Value* plane);
    Value* loaded(Value* plane);
    void load_offsets();
    Value* base();
    Value* numbers(unsigned array);
    template <typename Load>
    Load* mark(Load* load) {
        return frame_.aliases().mark(load, 0);
    }
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
    Value* base_ = nullptr;
    std::vector<Value*> offsets_;  ///< By lane, or one vector of all lanes if they are gathered.
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

/// The number of the element from which the offsets of the entry count.
Value* LinkEntry::base() {
    if (base_) return base_;
    llvm::Type* index = builder_.getInt32Ty();
    Value* entry = builder_.CreateUDiv(link_, builder_.getInt64(slice_cells));
    Value* address = builder_.CreateInBoundsGEP(index, frame_.extra_argument(bases), entry);
    base_ = builder_.CreateSExt(mark(builder_.CreateAlignedLoad(index, address, alignment(4))),
                                builder_.getInt64Ty());
    return base_;
}

// Where loads bound the loop, one load of 64 bits holds four offsets, which shifts take apart.
void LinkEntry::load_offsets() {
    llvm::Type* half = builder_.getInt16Ty();
    llvm::Type* word = builder_.getInt64Ty();
    if (frame_.shape().has_fast_gathers) {
        llvm::LoadInst* all =
            builder_.CreateAlignedLoad(frame_.vector_of(half), address(offsets, half),
                                       alignment(2 * frame_.lanes()));
        offsets_ = {builder_.CreateSExt(mark(all), frame_.vector_of(builder_.getInt32Ty()))};
        return;
    }
    Value* four = nullptr;
    const int together = frame_.shape().is_short_of_loads ? 4 : 1;
    const bool low_is_first = frame_.function().getDataLayout().isLittleEndian();
    for (int lane = 0; lane < frame_.lanes(); ++lane) {
        if (together == 1) {
            llvm::LoadInst* one =
                builder_.CreateAlignedLoad(half, address(offsets, half, lane), alignment(2));
            offsets_.push_back(builder_.CreateSExt(mark(one), word));
            continue;
        }
        if (lane % together == 0) {
            four =
                mark(builder_.CreateAlignedLoad(word, address(offsets, half, lane), alignment(8)));
        }
        const int place = low_is_first ? lane % together : together - 1 - lane % together;
        offsets_.push_back(builder_.CreateAShr(builder_.CreateShl(four, 48 - 16 * place), 48));
    }
}

Value* LinkEntry::at_targets(FieldSlot slot) {
    Value*& value = fields_[slot];
    if (value) return value;
    if (offsets_.empty()) load_offsets();
    Value* plane = builder_.CreateInBoundsGEP(frame_.number(), frame_.field_plane(slot), base());
    value = frame_.shape().has_fast_gathers ? gathered(plane) : loaded(plane);
    return value;
}

Value* LinkEntry::gathered(Value* plane) {
    Value* addresses = builder_.CreateInBoundsGEP(frame_.number(), plane, offsets_[0]);
    return mark(builder_.CreateMaskedGather(frame_.vector_of(frame_.number()), addresses,
                                            alignment(frame_.number_bytes())));
}

Value* LinkEntry::loaded(Value* plane) {
    Value* value = llvm::PoisonValue::get(frame_.vector_of(frame_.number()));
    for (std::size_t lane = 0; lane < offsets_.size(); ++lane) {
        Value* address = builder_.CreateInBoundsGEP(frame_.number(), plane, offsets_[lane]);
        llvm::LoadInst* load =
            builder_.CreateAlignedLoad(frame_.number(), address, alignment(frame_.number_bytes()));
        value = builder_.CreateInsertElement(value, mark(load), lane);
    }
    return value;
}

// Most of what a step reads are links: with prefetches a million cells take 0.91 to 0.96 of the
// time, cells that fit into the cache the same. The addresses may lie beyond the arrays.
void LinkEntry::prefetch_ahead() {
    constexpr int entries = 32;
    const auto prefetch = [&](unsigned array, llvm::Type* element) {
        Value* link =
            builder_.CreateAdd(link_,
                               builder_.getInt64(entries * static_cast<std::int64_t>(slice_cells)));
        frame_.prefetch(builder_, builder_.CreateGEP(element, frame_.extra_argument(array), link));
    };
    prefetch(offsets, builder_.getInt16Ty());
    for (const auto& [array, value] : numbers_) prefetch(array, frame_.number());
}

Value* LinkEntry::numbers(unsigned array) {
    Value*& value = numbers_[array];
    if (!value) {
        llvm::LoadInst* load = builder_.CreateAlignedLoad(frame_.vector_of(frame_.number()),
                                                          address(array, frame_.number()),
                                                          alignment(frame_.vector_bytes()));
        value = mark(load);
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
    Value* slices =
        builder_.CreateUDiv(builder_.CreateAdd(frame_.column_end(), count(slice_cells - 1)),
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
    entry.prefetch_ahead();
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

llvm::Function* build_linked_function(llvm::Module& module, const KernelPart& part,
                                      const KernelShape& shape, const std::string& name) {
    const std::vector<llvm::Type*> extra(array_count,
                                         llvm::PointerType::getUnqual(module.getContext()));
    return build_function(module, part, shape, name, extra,
                          [](KernelFrame& frame, KernelLoops& loops, Builder& builder) {
                              loops.rows(builder, frame.row_begin(), 1,
                                         [&](llvm::ArrayRef<CellVector> row, Builder& inner) {
                                             LinkedSources cells(frame, inner, row[0]);
                                             loops.body(cells, inner, row[0]);
                                         });
                              builder.CreateRetVoid();
                          });
}

}  // namespace cascade
