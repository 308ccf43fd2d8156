// Loads and gathers the fields' values at the targets of an entry's links.
#include "jit/link_entry.h"

#include <algorithm>
#include <array>

namespace cascade {

using llvm::Value;

namespace {

/// The array of weights by which a sum multiplies its differences.
LinkArgument::Number weights_of(Op op) {
    switch (op) {
        case Op::gradient_x: return LinkArgument::gradient_x;
        case Op::gradient_y: return LinkArgument::gradient_y;
        case Op::gradient_z: return LinkArgument::gradient_z;
        default: return LinkArgument::weights;
    }
}

}  // namespace

std::optional<std::size_t> PairedFields::with(FieldSlot slot) const {
    for (std::size_t pair = 0; pair < pairs_.size(); ++pair) {
        if (pairs_[pair][0] == slot || pairs_[pair][1] == slot) return pair;
    }
    return std::nullopt;
}

PairedFields::PairedFields(KernelFrame& frame, Builder& builder)
    : pairs_(field_pairs(frame.kernel())),
      first_(frame.extra_argument(LinkArgument::first_of_pairs)) {
    if (pairs_.empty()) return;
    Value* end = frame.extra_argument(LinkArgument::end_of_pairs);
    Value* count = builder.CreateSub(end, first_);
    for (std::size_t pair = 0; pair < pairs_.size(); ++pair) {
        Value* before = builder.CreateMul(count, builder.getInt64(pair));
        copies_.push_back(builder.CreateInBoundsGEP(
            both(builder), frame.extra_argument(LinkArgument::pair_scratch), before));
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

Value* LinkEntry::term(SumKey sum) {
    const auto [op, payload] = sum;
    const Flow flow = Flow::with(payload);
    Value* change = difference(flow.of);
    if (op == Op::link_squares) change = builder_.CreateFMul(change, change);
    if (op == Op::link_flow) {
        Value* factors = builder_.CreateFAdd(at_targets(flow.factor), cells_.field(flow.factor));
        change = builder_.CreateFMul(factors, change);
    }
    Value* weights = op == Op::link_weighted ? numbers_of(flow.factor) : numbers(weights_of(op));
    return builder_.CreateFMul(weights, change);
}

Value* LinkEntry::difference(FieldSlot slot) {
    Value*& value = differences_[slot];
    if (!value) value = builder_.CreateFSub(at_targets(slot), cells_.field(slot));
    return value;
}

Value* LinkEntry::address_of_entry(unsigned array, llvm::Type* element) {
    Value* entry = builder_.CreateUDiv(link_, builder_.getInt64(links_of_entry));
    return builder_.CreateInBoundsGEP(element, frame_.extra_argument(array), entry);
}

/// The number of the element from which the entry's offsets are counted.
Value* LinkEntry::base() {
    if (base_) return base_;
    llvm::Type* index = builder_.getInt32Ty();
    Value* address = address_of_entry(LinkArgument::bases, index);
    base_ = builder_.CreateSExt(mark(builder_.CreateAlignedLoad(index, address, alignment(4))),
                                builder_.getInt64Ty());
    return base_;
}

Value* LinkEntry::is_link() {
    if (is_link_) return is_link_;
    llvm::Type* half = builder_.getInt16Ty();
    Value* address = address_of_entry(LinkArgument::filled, half);
    llvm::Type* word = frame_.word();
    Value* bits = builder_.CreateZExt(mark(builder_.CreateAlignedLoad(half, address, alignment(2))),
                                      builder_.getInt64Ty());
    const auto lanes = static_cast<std::uint64_t>(frame_.lanes());
    if (lanes < links_of_entry) {
        bits = builder_.CreateLShr(bits, builder_.CreateAnd(link_,
                                                            builder_.getInt64(links_of_entry - 1)));
    }
    std::vector<llvm::Constant*> places;
    for (std::uint64_t lane = 0; lane < lanes; ++lane) {
        places.push_back(llvm::ConstantInt::get(word, std::uint64_t{1} << lane));
    }
    Value* all = frame_.splat(builder_, builder_.CreateTrunc(bits, word));
    is_link_ = builder_.CreateIsNotNull(builder_.CreateAnd(all, llvm::ConstantVector::get(places)));
    return is_link_;
}

// One load of 64 bits reads four offsets, which shifts then separate, because the number of loads
// limits the loop's speed. On an Intel Xeon, this takes as long as four separate loads.
void LinkEntry::load_offsets() {
    llvm::Type* half = builder_.getInt16Ty();
    llvm::Type* word = builder_.getInt64Ty();
    if (gathers_) {
        llvm::LoadInst* all =
            builder_.CreateAlignedLoad(frame_.vector_of(half), address(LinkArgument::offsets, half),
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
            several = mark(builder_.CreateAlignedLoad(builder_.getIntNTy(bits),
                                                      address(LinkArgument::offsets, half, lane),
                                                      alignment(2 * together)));
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

// Each 16 bytes of `low` contain two cells, and the same bytes of `high` contain the next two,
// because shuffles within 16 bytes are fast. Gathers leave the cells in order, because with AVX-512
// all shuffles cost the same.
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

/// The values at the targets of the given lanes, as one vector.
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

// Most of the data that a step reads are links. Prefetches shorten a step of a million cells to 91
// to 96 % of its time without them, and do not change the time if all cells fit into the cache. The
// addresses may be beyond the ends of the arrays, because a prefetch never faults.
void LinkEntry::prefetch_ahead() {
    constexpr int entries = 32;
    const auto prefetch = [&](Value* array, llvm::Type* element) {
        Value* link = builder_.CreateAdd(
            link_, builder_.getInt64(entries * static_cast<std::int64_t>(links_of_entry)));
        frame_.prefetch(builder_, builder_.CreateGEP(element, array, link));
    };
    prefetch(frame_.extra_argument(LinkArgument::offsets), builder_.getInt16Ty());
    for (const auto& [array, value] : numbers_) {
        prefetch(frame_.extra_argument(array), frame_.number());
    }
    for (const auto& [slot, value] : of_links_) prefetch(frame_.field_plane(slot), frame_.number());
}

Value* LinkEntry::numbers_of(FieldSlot slot) {
    Value*& value = of_links_[slot];
    if (!value) {
        Value* from = builder_.CreateInBoundsGEP(frame_.number(), frame_.field_plane(slot), link_);
        value = mark(builder_.CreateAlignedLoad(frame_.vector_of(frame_.number()), from,
                                                alignment(frame_.vector_bytes())));
    }
    return value;
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

}  // namespace cascade
