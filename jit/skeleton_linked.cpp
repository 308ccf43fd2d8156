// Sums over links.
//
// For each vector of cells one loop over the entries of its slice computes all sums of the kernel
// together: offsets and weights are loaded once, and what a field holds at the targets is read
// once, however many sums ask for it.
#include "jit/skeleton_linked.h"

#include "core/links.h"
#include "jit/field_pairs.h"
#include "jit/skeleton.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>
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
    pair_scratch,
    first_of_pairs,
    end_of_pairs,
    argument_count
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

/// Copies of fields whose numbers are side by side.
class PairedFields {
public:
    /// Writes the loop that makes the copies, and goes on after it.
    PairedFields(KernelFrame& frame, Builder& builder);

    /// The pair that has this field.
    std::optional<std::size_t> with(FieldSlot slot) const;
    const FieldPair& slots(std::size_t pair) const { return pairs_[pair]; }
    bool empty() const { return pairs_.empty(); }
    /// The address of both numbers of an element.
    Value* address(Builder& builder, std::size_t pair, Value* element) const {
        Value* number = builder.CreateSub(element, first_);
        return builder.CreateInBoundsGEP(both(builder), copies_[pair], number);
    }
    /// Both numbers of a cell, as loads and gathers take them.
    static llvm::Type* both(Builder& builder) { return builder.getDoubleTy(); }

private:
    std::vector<FieldPair> pairs_;
    Value* first_;
    std::vector<Value*> copies_;  ///< By pair.
};

std::optional<std::size_t> PairedFields::with(FieldSlot slot) const {
    for (std::size_t pair = 0; pair < pairs_.size(); ++pair) {
        if (pairs_[pair][0] == slot || pairs_[pair][1] == slot) return pair;
    }
    return std::nullopt;
}

PairedFields::PairedFields(KernelFrame& frame, Builder& builder)
    : pairs_(field_pairs(frame.kernel())), first_(frame.extra_argument(first_of_pairs)) {
    if (pairs_.empty()) return;
    Value* end = frame.extra_argument(end_of_pairs);
    Value* count = builder.CreateSub(end, first_);
    for (std::size_t pair = 0; pair < pairs_.size(); ++pair) {
        Value* before = builder.CreateMul(count, builder.getInt64(pair));
        copies_.push_back(
            builder.CreateInBoundsGEP(both(builder), frame.extra_argument(pair_scratch), before));
    }
    const int lanes = frame.lanes();
    llvm::SmallVector<int, 32> alternating;
    for (int lane = 0; lane < lanes; ++lane) {
        alternating.push_back(lane);
        alternating.push_back(lanes + lane);
    }
    llvm::BasicBlock* before = builder.GetInsertBlock();
    llvm::BasicBlock* copy = frame.new_block("pairs");
    llvm::BasicBlock* after = frame.new_block("pairs_done");
    builder.CreateCondBr(builder.CreateICmpSLT(first_, end), copy, after);
    builder.SetInsertPoint(copy);
    llvm::PHINode* element = builder.CreatePHI(builder.getInt64Ty(), 2, "element");
    for (std::size_t pair = 0; pair < pairs_.size(); ++pair) {
        const auto numbers = [&](FieldSlot slot) {
            Value* from =
                builder.CreateInBoundsGEP(frame.number(), frame.field_plane(slot), element);
            return builder.CreateAlignedLoad(frame.vector_of(frame.number()), from,
                                             alignment(frame.vector_bytes()));
        };
        Value* one = numbers(pairs_[pair][0]);
        builder.CreateAlignedStore(
            builder.CreateShuffleVector(one, numbers(pairs_[pair][1]), alternating),
            address(builder, pair, element), alignment(frame.vector_bytes()));
    }
    Value* next = builder.CreateAdd(element, builder.getInt64(lanes));
    builder.CreateCondBr(builder.CreateICmpSLT(next, end), copy, after);
    element->addIncoming(first_, before);
    element->addIncoming(next, copy);
    builder.SetInsertPoint(after);
}

/// What one entry of a slice holds for a vector of cells.
class LinkEntry {
public:
    /// `link` is the number of the vector's first link; `cells` have loaded their own values.
    LinkEntry(KernelFrame& frame, Builder& builder, Value* link, CellSources& cells,
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

    /// What it adds to a sum.
    Value* term(SumKey sum);
    /// Asks for offsets and weights of later entries.
    void prefetch_ahead();

private:
    /// f_j − f_i.
    Value* difference(FieldSlot slot);
    Value* at_targets(FieldSlot slot);
    void fetch_pair(std::size_t pair);
    Value* gathered(llvm::Type* element, Value* base);
    Value* loaded(llvm::Type* element, Value* base, llvm::ArrayRef<int> lanes);
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
    const PairedFields& paired_;
    std::vector<int> lanes_;                            ///< In order.
    bool gathers_;                                      ///< Vectors, by one instruction or two.
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

// One load of 64 bits holds four offsets, which shifts take apart, since it is loads that bound the
// loop. On an Intel Xeon this takes as long as a load for each.
void LinkEntry::load_offsets() {
    llvm::Type* half = builder_.getInt16Ty();
    llvm::Type* word = builder_.getInt64Ty();
    if (gathers_) {
        llvm::LoadInst* all =
            builder_.CreateAlignedLoad(frame_.vector_of(half), address(offsets, half),
                                       alignment(2 * frame_.lanes()));
        offsets_ = {builder_.CreateSExt(mark(all), frame_.vector_of(builder_.getInt32Ty()))};
        return;
    }
    const int together = std::min(4, frame_.lanes());
    const bool low_is_first = frame_.function().getDataLayout().isLittleEndian();
    const unsigned bits = 16 * static_cast<unsigned>(together);
    Value* several = nullptr;
    for (int lane = 0; lane < frame_.lanes(); ++lane) {
        const int position = lane % together;
        if (position == 0) {
            several = mark(builder_.CreateAlignedLoad(
                builder_.getIntNTy(bits), address(offsets, half, lane), alignment(2 * together)));
            several = builder_.CreateZExt(several, word);
        }
        const int place = low_is_first ? position : together - 1 - position;
        offsets_.push_back(builder_.CreateAShr(builder_.CreateShl(several, 48 - 16 * place), 48));
    }
}

Value* LinkEntry::at_targets(FieldSlot slot) {
    if (Value* known = fields_[slot]) return known;
    if (offsets_.empty()) load_offsets();
    if (const auto pair = paired_.with(slot)) {
        fetch_pair(*pair);
    } else {
        llvm::Type* number = frame_.number();
        Value* from = builder_.CreateInBoundsGEP(number, frame_.field_plane(slot), base());
        fields_[slot] = gathers_ ? gathered(number, from) : loaded(number, from, lanes_);
    }
    return fields_[slot];
}

// In each 16 bytes of `low` are two cells and in those of `high` the next two, because shuffles
// within 16 bytes are fast. Gathers leave cells in order, since AVX-512 shuffles anything at once.
void LinkEntry::fetch_pair(std::size_t pair) {
    llvm::Type* both = PairedFields::both(builder_);
    Value* from = paired_.address(builder_, pair, base());
    std::array<llvm::SmallVector<int, 16>, 2> of_side;
    Value *low = nullptr, *high = nullptr;
    const int lanes = frame_.lanes();
    const auto numbers = [&](Value* pairs) {
        return builder_.CreateBitCast(pairs, frame_.vector_of(frame_.number()));
    };
    if (gathers_) {
        Value* all = gathered(both, from);
        auto* half = llvm::FixedVectorType::get(both, static_cast<unsigned>(lanes / 2));
        low = numbers(builder_.CreateExtractVector(half, all, builder_.getInt64(0)));
        high = numbers(builder_.CreateExtractVector(half, all, builder_.getInt64(lanes / 2)));
        for (int lane = 0; lane < lanes; ++lane) {
            for (const int side : {0, 1}) of_side[side].push_back(2 * lane + side);
        }
    } else {
        std::array<llvm::SmallVector<int, 16>, 2> cells;
        for (int lane = 0; lane < lanes; ++lane) {
            const int vector = lane % 4 / 2;
            for (const int side : {0, 1}) {
                const auto place = static_cast<int>(cells[vector].size());
                of_side[side].push_back(lanes * vector + 2 * place + side);
            }
            cells[vector].push_back(lane);
        }
        low = numbers(loaded(both, from, cells[0]));
        high = numbers(loaded(both, from, cells[1]));
    }
    const FieldPair& slots = paired_.slots(pair);
    for (const std::size_t side : {0, 1}) {
        fields_[slots[side]] = builder_.CreateShuffleVector(low, high, of_side[side]);
    }
}

Value* LinkEntry::gathered(llvm::Type* element, Value* from) {
    Value* addresses = builder_.CreateInBoundsGEP(element, from, offsets_[0]);
    return mark(builder_.CreateMaskedGather(
        frame_.vector_of(element), addresses,
        alignment(static_cast<int>(element->getScalarSizeInBits() / 8))));
}

/// What lies at the targets of some lanes, as one vector.
Value* LinkEntry::loaded(llvm::Type* element, Value* from, llvm::ArrayRef<int> lanes) {
    Value* value = llvm::PoisonValue::get(
        llvm::FixedVectorType::get(element, static_cast<unsigned>(lanes.size())));
    for (std::size_t k = 0; k < lanes.size(); ++k) {
        Value* offset = offsets_[static_cast<std::size_t>(lanes[k])];
        llvm::LoadInst* load = builder_.CreateAlignedLoad(
            element, builder_.CreateInBoundsGEP(element, from, offset),
            alignment(static_cast<int>(element->getScalarSizeInBits() / 8)));
        value = builder_.CreateInsertElement(value, mark(load), k);
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

private:
    void add_up();
    void load_own();
    Value* start_of(Value* slice);

    const PairedFields& paired_;
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
    LinkEntry entry(frame_, builder_, link, *this, paired_);
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
    std::vector<llvm::Type*> extra(argument_count,
                                   llvm::PointerType::getUnqual(module.getContext()));
    extra[first_of_pairs] = extra[end_of_pairs] = llvm::Type::getInt64Ty(module.getContext());
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
