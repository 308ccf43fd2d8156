// Row and column loops, loads of own cells and stores.
#include "jit/skeleton.h"

namespace cascade {

using llvm::Value;

Value* KernelFrame::uniform(std::size_t slot) {
    Value* address = builder_.CreateConstInBoundsGEP1_64(number(), function_.getArg(2), slot);
    llvm::LoadInst* load = builder_.CreateAlignedLoad(number(), address, alignment(number_bytes()));
    return splat(builder_, aliases_.mark(load, 0));
}

Value* KernelFrame::hidden(std::uint64_t word) {
    llvm::Constant* value =
        llvm::ConstantFP::get(number(), number_constant(word, kernel_.precision));
    auto* variable = new llvm::GlobalVariable(*function_.getParent(), number(), false,
                                              llvm::GlobalValue::PrivateLinkage, value,
                                              "hidden");  // The module owns it.
    return splat(builder_,
                 builder_.CreateAlignedLoad(number(), variable, alignment(number_bytes())));
}

void KernelFrame::prefetch(Builder& builder, Value* address) const {
    const auto word = [&](unsigned value) { return builder.getInt32(value); };
    builder.CreateIntrinsic(llvm::Intrinsic::prefetch, {builder.getPtrTy()},
                            {address, word(0), word(3), word(1)});  // To read, to L1, data.
}

// Loaded once, before the loops. `table` is the number of the argument.
Value* KernelFrame::plane(unsigned table, std::size_t slot) {
    Value*& address = planes_[{table, slot}];
    if (!address) {
        llvm::Type* type = builder_.getPtrTy();
        Value* entry = builder_.CreateConstInBoundsGEP1_64(type, function_.getArg(table), slot);
        address = builder_.CreateAlignedLoad(type, entry, alignment(8));
    }
    return address;
}

Value* CarriedVectors::take(std::uint32_t slot,
                            llvm::function_ref<Value*(Builder& outside)> first) {
    Carried& carried = carried_[slot];
    carried.first = first(outside_);
    carried.entering = llvm::PHINode::Create(carried.first->getType(), 2, "carried");
    carried.entering->insertBefore(header_.getFirstNonPHIIt());
    return carried.entering;
}

void CarriedVectors::give(std::uint32_t slot, Value* vector) { carried_[slot].next = vector; }

void CarriedVectors::close(llvm::BasicBlock* before, llvm::BasicBlock* latch) {
    for (auto& [slot, carried] : carried_) {
        carried.entering->addIncoming(carried.first, before);
        carried.entering->addIncoming(carried.next, latch);
    }
}

Value* CellLane::field(std::uint32_t slot) {
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

Value* CellLane::mask(std::uint32_t slot) {
    llvm::Type* byte = builder_.getInt8Ty();
    Value* address = builder_.CreateInBoundsGEP(byte, frame_.mask_plane(slot), element_);
    llvm::LoadInst* bytes =
        builder_.CreateAlignedLoad(frame_.vector_of(byte), address, alignment(frame_.lanes()));
    return builder_.CreateIsNotNull(frame_.aliases().mark(bytes, 0));
}

Value* CellLane::cell_column() {
    llvm::Type* word = frame_.word();
    Value* first = builder_.CreateTrunc(builder_.CreateSub(element_, place_.row_start), word);
    std::vector<llvm::Constant*> counts;
    for (int lane = 0; lane < frame_.lanes(); ++lane) {
        counts.push_back(llvm::ConstantInt::get(word, static_cast<unsigned>(lane)));
    }
    return builder_.CreateAdd(frame_.splat(builder_, first), llvm::ConstantVector::get(counts));
}

void CellLane::store(std::size_t result, Value* number) {
    Value* address =
        builder_.CreateInBoundsGEP(frame_.number(), frame_.result_plane(result), element_);
    frame_.aliases().mark(
        builder_.CreateAlignedStore(number, address, alignment(frame_.vector_bytes())), result + 1);
}

Value* KernelLoops::OuterLane::cell_row() {
    Value* row = row_;
    if (frame_.has_slices()) {
        Value* first = builder_.CreateMul(frame_.slice(), frame_.slice_rows());
        row = builder_.CreateSub(row, first);
    }
    return word(row);
}

Value* KernelLoops::OuterLane::cell_slice() {
    return word(frame_.has_slices() ? frame_.slice() : builder_.getInt64(0));
}

Value* KernelLoops::OuterLane::word(Value* count) {
    return frame_.splat(builder_, builder_.CreateTrunc(count, frame_.word()));
}

KernelLoops::KernelLoops(KernelFrame& frame)
    : frame_(frame),
      levels_(levels_of(frame.kernel())),
      lane_(frame, frame.builder(), nullptr),
      scope_(frame.kernel(), levels_, Level::call, frame.builder(), lane_, frame.shape(), nullptr) {
    scope_.emit();
}

void KernelLoops::rows(Builder& place, Cells cells) {
    llvm::BasicBlock* test = frame_.new_block("rows");
    llvm::BasicBlock* start = frame_.new_block("row");
    llvm::BasicBlock* next = frame_.new_block("row_done");
    llvm::BasicBlock* after = frame_.new_block("rows_done");
    llvm::BasicBlock* before = place.GetInsertBlock();
    place.CreateBr(test);

    place.SetInsertPoint(test);
    // The number of the first row is said at once: LLVM takes a number that comes from nowhere for
    // not 0.
    llvm::PHINode* row = place.CreatePHI(place.getInt64Ty(), 2, "row");
    row->addIncoming(frame_.row_begin(), before);
    place.CreateCondBr(place.CreateICmpSLT(row, frame_.row_end()), start, after);

    place.SetInsertPoint(start);
    columns(row, place, next, cells);

    place.SetInsertPoint(next);
    Value* below = place.CreateNSWAdd(row, place.getInt64(1));
    place.CreateBr(test);
    row->addIncoming(below, next);
    place.SetInsertPoint(after);
}

// `place` is in the block before the columns, which is where the values of a row go. It stays
// open while they come: LLVM's folding follows jumps, and cannot bear to find an empty block.
void KernelLoops::columns(Value* row, Builder& place, llvm::BasicBlock* next, Cells cells) {
    llvm::BasicBlock* vector = frame_.new_block("cells");
    Value* start = place.CreateNSWMul(row, frame_.stride(), "row_start");
    Value* end = place.CreateNSWAdd(start, frame_.width());
    OuterLane row_lane(frame_, place, row);
    BodyScope row_scope(frame_.kernel(), levels_, Level::row, place, row_lane, frame_.shape(),
                        &scope_);
    row_scope.emit();

    Builder inner(vector, frame_.folder());
    llvm::PHINode* element = inner.CreatePHI(inner.getInt64Ty(), 2, "element");
    CarriedVectors carried(*vector, place);
    cells({row, start, element, &carried}, inner, row_scope);
    Value* after = inner.CreateNSWAdd(element, inner.getInt64(frame_.lanes()));
    inner.CreateCondBr(inner.CreateICmpSLT(after, end), vector, next);
    element->addIncoming(start, place.GetInsertBlock());
    element->addIncoming(after, inner.GetInsertBlock());
    carried.close(place.GetInsertBlock(), inner.GetInsertBlock());
    place.CreateBr(vector);
}

void KernelLoops::body(CellLane& lane, Builder& builder, BodyScope& row_scope) {
    const CellKernel& kernel = frame_.kernel();
    BodyScope scope(kernel, levels_, Level::cell, builder, lane, frame_.shape(), &row_scope);
    scope.emit();
    for (std::size_t result = 0; result < kernel.results.size(); ++result) {
        lane.store(result, scope.number(kernel.results[result]));
    }
}

llvm::Function* build_function(
    llvm::Module& module, const CellKernel& kernel, const KernelShape& shape,
    const std::string& name, llvm::ArrayRef<llvm::Type*> further,
    llvm::function_ref<void(KernelFrame& frame, KernelLoops& loops, Builder& place)> loops) {
    llvm::LLVMContext& context = module.getContext();
    llvm::Type* pointer = llvm::PointerType::getUnqual(context);
    llvm::Type* count = llvm::Type::getInt64Ty(context);
    std::vector<llvm::Type*> arguments{pointer, pointer, pointer, pointer,
                                       count,   count,   count,   count};
    arguments.insert(arguments.end(), further.begin(), further.end());
    auto* type = llvm::FunctionType::get(llvm::Type::getVoidTy(context), arguments, false);
    auto* function = llvm::Function::Create(type, llvm::GlobalValue::ExternalLinkage, name, module);
    function->setDoesNotThrow();

    // What is needed once goes to the end of the first block while the loops after it are built;
    // like all blocks that are written to, it is closed last.
    llvm::BasicBlock* entry = llvm::BasicBlock::Create(context, "entry", function);
    llvm::BasicBlock* begin = llvm::BasicBlock::Create(context, "begin", function);
    const llvm::InstSimplifyFolder folder(module.getDataLayout());
    Builder entry_builder(entry, folder);
    KernelFrame frame(*function, kernel, shape, entry_builder);
    KernelLoops kernel_loops(frame);

    Builder builder(begin, folder);
    loops(frame, kernel_loops, builder);
    entry_builder.CreateBr(begin);
    return function;
}

}  // namespace cascade
