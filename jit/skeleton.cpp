// Writes the loops over rows and vectors, loads of the cells' own values, and stores.
#include "jit/skeleton.h"

#include "core/check.h"

#include <deque>

namespace cascade {

using llvm::Value;

Value* KernelFrame::uniform(UniformSlot slot) {
    Value* address =
        builder_.CreateConstInBoundsGEP1_64(number(), function_.getArg(2), slot.index());
    llvm::LoadInst* load = builder_.CreateAlignedLoad(number(), address, alignment(number_bytes()));
    return splat(builder_, aliases_.mark(load, 0));
}

Value* KernelFrame::hidden(std::uint64_t word) {
    llvm::Constant* value =
        llvm::ConstantFP::get(number(), number_constant(word, kernel().precision));
    auto* variable = new llvm::GlobalVariable(*function_.getParent(), number(), false,
                                              llvm::GlobalValue::PrivateLinkage, value,
                                              "hidden");  // The module owns the variable.
    return splat(builder_,
                 builder_.CreateAlignedLoad(number(), variable, alignment(number_bytes())));
}

void KernelFrame::prefetch(Builder& builder, Value* address) const {
    const auto word = [&](unsigned value) { return builder.getInt32(value); };
    builder.CreateIntrinsic(llvm::Intrinsic::prefetch, {builder.getPtrTy()},
                            // A read of data, to be kept in the L1 cache.
                            {address, word(0), word(3), word(1)});
}

// `table` is the position of the table among the arguments.
Value* KernelFrame::plane(unsigned table, std::size_t slot) {
    Value*& address = planes_[{table, slot}];
    if (!address) {
        llvm::Type* type = builder_.getPtrTy();
        Value* entry = builder_.CreateConstInBoundsGEP1_64(type, function_.getArg(table), slot);
        address = builder_.CreateAlignedLoad(type, entry, alignment(8));
    }
    return address;
}

Value* CarriedVectors::take(FieldSlot slot, llvm::function_ref<Value*(Builder& outside)> first) {
    Carried& carried = carried_[slot];
    carried.first = first(outside_);
    carried.entering = llvm::PHINode::Create(carried.first->getType(), 2, "carried");
    carried.entering->insertBefore(header_.getFirstNonPHIIt());
    return carried.entering;
}

void CarriedVectors::give(FieldSlot slot, Value* vector) { carried_[slot].next = vector; }

void CarriedVectors::close(llvm::BasicBlock* before, llvm::BasicBlock* latch) {
    for (auto& [slot, carried] : carried_) {
        carried.entering->addIncoming(carried.first, before);
        carried.entering->addIncoming(carried.next, latch);
    }
}

Value* CellSources::field(FieldSlot slot) {
    Value*& value = loads_[slot];
    if (!value) {
        llvm::Type* number = frame_.number();
        Value* address = builder_.CreateInBoundsGEP(number, frame_.field_plane(slot), element_);
        value = frame_.mark(builder_.CreateAlignedLoad(frame_.vector_of(number), address,
                                                       alignment(frame_.vector_bytes())),
                            slot);
    }
    return value;
}

Value* CellSources::mask(MaskSlot slot) {
    llvm::Type* byte = builder_.getInt8Ty();
    Value* address = builder_.CreateInBoundsGEP(byte, frame_.mask_plane(slot), element_);
    llvm::LoadInst* bytes =
        builder_.CreateAlignedLoad(frame_.vector_of(byte), address, alignment(frame_.lanes()));
    return builder_.CreateIsNotNull(frame_.aliases().mark(bytes, 0));
}

Value* CellSources::cell_column() {
    llvm::Type* word = frame_.word();
    Value* first = builder_.CreateTrunc(builder_.CreateSub(element_, vector_.row_start), word);
    std::vector<llvm::Constant*> counts;
    for (int lane = 0; lane < frame_.lanes(); ++lane) {
        counts.push_back(llvm::ConstantInt::get(word, static_cast<unsigned>(lane)));
    }
    return builder_.CreateAdd(frame_.splat(builder_, first), llvm::ConstantVector::get(counts));
}

void CellSources::store(std::size_t result, Value* number) {
    Value* address =
        builder_.CreateInBoundsGEP(frame_.number(), frame_.result_plane(result), element_);
    frame_.aliases().mark(
        builder_.CreateAlignedStore(number, address, alignment(frame_.vector_bytes())), result + 1);
}

void CellSources::reduce_links(BodyScope&, const LinkLoop&) {
    CHECK(false, "only linked cells have links");
}

Value* KernelLoops::OuterSources::cell_row() {
    Value* row = row_;
    if (frame_.has_slices()) {
        Value* first = builder_.CreateMul(frame_.slice(), frame_.slice_rows());
        row = builder_.CreateSub(row, first);
    }
    return word(row);
}

Value* KernelLoops::OuterSources::cell_slice() {
    return word(frame_.has_slices() ? frame_.slice() : builder_.getInt64(0));
}

Value* KernelLoops::OuterSources::word(Value* count) {
    return frame_.splat(builder_, builder_.CreateTrunc(count, frame_.word()));
}

KernelLoops::KernelLoops(KernelFrame& frame)
    : frame_(frame),
      body_(body_of(frame.kernel(), frame.shape(), frame.builder())),
      schedule_(cell_schedule_of(frame.kernel(), body_.levels)),
      sources_(frame, frame.builder(), nullptr),
      scope_(body_, LoopLevel::call, frame.builder(), sources_, nullptr) {
    emit_body(scope_);
}

Value* KernelLoops::rows(Builder& builder, Value* first, int together, WriteVectors write_vectors,
                         WriteRowEnd write_row_end) {
    llvm::BasicBlock* test = frame_.new_block("rows");
    llvm::BasicBlock* start = frame_.new_block("row");
    llvm::BasicBlock* next = frame_.new_block("row_done");
    llvm::BasicBlock* after = frame_.new_block("rows_done");
    llvm::BasicBlock* before = builder.GetInsertBlock();
    builder.CreateBr(test);

    builder.SetInsertPoint(test);
    // The node gets its first incoming value at once, because LLVM assumes that a phi node without
    // incoming values is not 0.
    llvm::PHINode* row = builder.CreatePHI(builder.getInt64Ty(), 2, "row");
    row->addIncoming(first, before);
    Value* last = builder.CreateNSWAdd(row, builder.getInt64(together - 1));
    builder.CreateCondBr(builder.CreateICmpSLT(last, frame_.row_end()), start, after);

    builder.SetInsertPoint(start);
    const std::vector<Value*> row_starts = columns(row, together, builder, next, write_vectors);

    builder.SetInsertPoint(next);
    for (Value* row_start : row_starts) {
        if (write_row_end) write_row_end(row_start, builder);
    }
    Value* below = builder.CreateNSWAdd(row, builder.getInt64(together));
    row->addIncoming(below, builder.GetInsertBlock());
    builder.CreateBr(test);
    builder.SetInsertPoint(after);
    return row;
}

// `outside` writes values of the rows to the block before the loop over their vectors. Values are
// added to this block while the loop is written, so it gets its terminator last. Until then it must
// not be empty, because InstSimplifyFolder follows jumps and fails at an empty block.
std::vector<Value*> KernelLoops::columns(Value* row, int together, Builder& outside,
                                         llvm::BasicBlock* next, WriteVectors write_vectors) {
    llvm::BasicBlock* loop = frame_.new_block("cells");
    Builder inner(loop, frame_.folder());
    llvm::PHINode* element = inner.CreatePHI(inner.getInt64Ty(), 2, "element");
    CarriedVectors carried(*loop, outside);

    std::vector<Value*> starts;
    std::deque<OuterSources> row_sources;
    std::deque<BodyScope> row_scopes;
    std::vector<CellVector> vectors;
    for (int k = 0; k < together; ++k) {
        Value* own_row = outside.CreateNSWAdd(row, outside.getInt64(k));
        starts.push_back(outside.CreateNSWMul(own_row, frame_.stride(), "row_start"));
        Value* own_first = outside.CreateNSWAdd(starts.back(), frame_.column_begin());
        row_sources.emplace_back(frame_, outside, own_row);
        row_scopes.emplace_back(body_, LoopLevel::row, outside, row_sources.back(), &scope_);
        emit_body(row_scopes.back());
        Value* below = inner.CreateNSWMul(frame_.stride(), inner.getInt64(k));
        vectors.push_back({own_row, starts.back(), own_first, inner.CreateNSWAdd(element, below),
                           &carried, &row_scopes.back()});
    }
    Value* end = outside.CreateNSWAdd(starts.front(), frame_.column_end());
    write_vectors(vectors, inner);
    Value* after = inner.CreateNSWAdd(element, inner.getInt64(frame_.lanes()));
    inner.CreateCondBr(inner.CreateICmpSLT(after, end), loop, next);
    element->addIncoming(vectors.front().first, outside.GetInsertBlock());
    element->addIncoming(after, inner.GetInsertBlock());
    carried.close(outside.GetInsertBlock(), inner.GetInsertBlock());
    outside.CreateBr(loop);
    return starts;
}

void KernelLoops::body(CellSources& cells, Builder& builder, const CellVector& vector) {
    BodyScope scope(body_, LoopLevel::cell, builder, cells, vector.row_scope);
    const std::vector<ValueId>& results = body_.kernel.results;
    std::size_t stored = 0;
    const auto store_next = [&] {
        cells.store(stored, scope.number(results[stored]));
        ++stored;
    };
    for (const LinkLoop& loop : schedule_.loops) {
        emit_values(scope, loop.before);
        cells.reduce_links(scope, loop);
    }
    emit_values(scope, schedule_.after, [&](ValueId done) {
        if (!frame_.part().is_in_order) return;
        while (stored < results.size() && results[stored] <= done) store_next();
    });
    while (stored < results.size()) store_next();
}

llvm::Function* build_function(
    llvm::Module& module, const KernelPart& part, const KernelShape& shape, const std::string& name,
    llvm::ArrayRef<llvm::Type*> extra,
    llvm::function_ref<void(KernelFrame& frame, KernelLoops& loops, Builder& builder)>
        write_loops) {
    llvm::LLVMContext& context = module.getContext();
    llvm::Type* pointer = llvm::PointerType::getUnqual(context);
    llvm::Type* count = llvm::Type::getInt64Ty(context);
    std::vector<llvm::Type*> arguments{pointer, pointer, pointer, pointer, count,
                                       count,   count,   count,   count};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    auto* type = llvm::FunctionType::get(llvm::Type::getVoidTy(context), arguments, false);
    auto* function = llvm::Function::Create(type, llvm::GlobalValue::ExternalLinkage, name, module);
    function->setDoesNotThrow();

    // Values that are computed once are added to the end of the first block while the later loops
    // are built. So this block gets its terminator last.
    llvm::BasicBlock* entry = llvm::BasicBlock::Create(context, "entry", function);
    llvm::BasicBlock* begin = llvm::BasicBlock::Create(context, "begin", function);
    const llvm::InstSimplifyFolder folder(module.getDataLayout());
    Builder entry_builder(entry, folder);
    KernelFrame frame(*function, part, shape, entry_builder);
    KernelLoops loops(frame);

    Builder builder(begin, folder);
    write_loops(frame, loops, builder);
    entry_builder.CreateBr(begin);
    return function;
}

}  // namespace cascade
