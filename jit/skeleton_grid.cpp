// Row and column loops, loads, stores and prefetches.
//
// All planes share one layout, so an element number serves them all: an access is a plane's address
// plus this number, which is an addressing mode of the processor. With the element numbers of the
// rows above and below, the innermost loop needs as many registers as there are planes, plus four.
#include "jit/skeleton_grid.h"

#include "jit/alias_scopes.h"
#include "jit/emit_body.h"

#include <map>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

namespace cascade {
namespace {

using llvm::Value;

// Rows of at least this width are computed while the rows behind them are prefetched. On narrower
// ones the processor sees far enough ahead by itself, and prefetching costs 5 to 10 %. Vectors of
// half a cache line prefetch each line twice, which pays only for planes that leave the caches.
constexpr int cache_line = 64;
std::int64_t least_width_to_prefetch(int vector_bytes) {
    return vector_bytes == cache_line ? 128 : 1024;
}

// Kernels up to this size get a loop without prefetching for narrow planes; in larger ones the
// prefetches cost nothing that could be noticed, and compiling the loop twice would.
constexpr std::size_t largest_twofold_kernel = 64;

llvm::Align alignment(int bytes) { return llvm::Align(static_cast<std::uint64_t>(bytes)); }

/// What all rows and vectors share: the arguments, the planes' addresses and the way to reach them.
class GridFrame {
public:
    GridFrame(llvm::Function& function, const CellKernel& kernel, const GridShape& shape,
              Builder& builder)
        : function_(function),
          kernel_(kernel),
          shape_(shape),
          precision_(kernel.precision),
          builder_(builder),
          aliases_(function.getContext(), kernel.results.size()) {}

    llvm::Function& function() { return function_; }
    Stencil stencil() const { return shape_.stencil; }
    int lanes() const { return shape_.lanes; }
    int number_bytes() const { return static_cast<int>(bytes_of(precision_)); }
    int vector_bytes() const { return lanes() * number_bytes(); }
    llvm::Type* number() const { return number_type(builder_, precision_); }
    llvm::Type* word() const { return word_type(builder_, precision_); }
    Builder& builder() { return builder_; }
    const AliasScopes& aliases() const { return aliases_; }

    Value* width() { return function_.getArg(4); }
    Value* stride() { return function_.getArg(5); }
    Value* row_begin() { return function_.getArg(6); }
    Value* row_end() { return function_.getArg(7); }
    bool has_slices() const { return stencil().z; }
    Value* slice_rows() { return function_.getArg(8); }
    Value* slice() { return function_.getArg(9); }

    Value* field_plane(std::size_t slot) { return plane(0, slot); }
    Value* mask_plane(std::size_t slot) { return plane(1, slot); }
    Value* result_plane(std::size_t slot) { return plane(3, slot); }

    llvm::Type* vector_of(llvm::Type* element) const {
        return llvm::FixedVectorType::get(element, static_cast<unsigned>(lanes()));
    }
    Value* splat(Builder& builder, Value* element) const {
        return builder.CreateVectorSplat(static_cast<unsigned>(lanes()), element);
    }

    /// Says that no result is written to the field that is read, where that is so.
    llvm::LoadInst* mark(llvm::LoadInst* load, std::uint32_t slot) const {
        return kernel_.reads_neighbours(slot) ? aliases_.mark(load, 0) : load;
    }

    Value* uniform(std::size_t slot) {
        Value* address = builder_.CreateConstInBoundsGEP1_64(number(), function_.getArg(2), slot);
        llvm::LoadInst* load =
            builder_.CreateAlignedLoad(number(), address, alignment(number_bytes()));
        return splat(builder_, aliases_.mark(load, 0));
    }

    /// A variable of the module that nobody changes; the code generator does not know that.
    Value* hidden(std::uint64_t word) {
        llvm::Constant* value = llvm::ConstantFP::get(number(), number_constant(word, precision_));
        auto* variable = new llvm::GlobalVariable(*function_.getParent(), number(), false,
                                                  llvm::GlobalValue::PrivateLinkage, value,
                                                  "hidden");  // The module owns it.
        return splat(builder_, builder_.CreateAlignedLoad(number(), variable,
                                                          alignment(number_bytes())));
    }

    /// Elements from a row to one that is `rows` rows and `slices` slices away.
    Value* row_step(int rows, int slices) {
        Value*& step = row_steps_[{rows, slices}];
        if (!step) {
            Value* count = builder_.getInt64(rows);
            if (slices != 0) {
                Value* across = builder_.CreateMul(slice_rows(), builder_.getInt64(slices));
                count = builder_.CreateAdd(across, count);
            }
            step = builder_.CreateMul(stride(), count);
        }
        return step;
    }

private:
    // Loaded once, in front of the loops. `table` is the number of the argument.
    Value* plane(unsigned table, std::size_t slot) {
        Value*& address = planes_[{table, slot}];
        if (!address) {
            llvm::Type* type = builder_.getPtrTy();
            Value* entry = builder_.CreateConstInBoundsGEP1_64(type, function_.getArg(table), slot);
            address = builder_.CreateAlignedLoad(type, entry, alignment(8));
        }
        return address;
    }

    llvm::Function& function_;
    const CellKernel& kernel_;
    GridShape shape_;
    Precision precision_;
    Builder& builder_;  ///< Writes in front of the loops.
    AliasScopes aliases_;
    std::map<std::pair<unsigned, std::size_t>, Value*> planes_;
    std::map<std::pair<int, int>, Value*> row_steps_;
};

/// What the cells of a call and of a row have in common.
class OuterLane final : public Lane {
public:
    OuterLane(GridFrame& frame, Builder& builder, Value* row)
        : frame_(frame), builder_(builder), row_(row) {}

    Value* uniform(std::uint32_t slot) override { return frame_.uniform(slot); }
    Value* hidden(std::uint64_t word) override { return frame_.hidden(word); }
    Value* cell_row() override {
        Value* row = row_;
        if (frame_.has_slices()) {
            Value* first = builder_.CreateMul(frame_.slice(), frame_.slice_rows());
            row = builder_.CreateSub(row, first);
        }
        return word(row);
    }
    Value* cell_slice() override {
        return word(frame_.has_slices() ? frame_.slice() : builder_.getInt64(0));
    }

private:
    Value* word(Value* count) {
        return frame_.splat(builder_, builder_.CreateTrunc(count, frame_.word()));
    }

    GridFrame& frame_;
    Builder& builder_;
    Value* row_;  ///< Null in front of the rows.
};

/// The vector of cells of one execution of the innermost loop.
class CellLane final : public Lane {
public:
    /// `element` is the number of the vector's first cell, `row_start` of its row's.
    CellLane(GridFrame& frame, Builder& builder, Value* row_start, Value* element)
        : frame_(frame), builder_(builder), row_start_(row_start) {
        elements_[{0, 0}] = opaque(element);
    }

    Value* field(std::uint32_t slot) override { return field(slot, 0, 0); }
    Value* laplacian(std::uint32_t slot) override;
    Value* neighbour(Neighbour at) override;
    Value* mask(std::uint32_t slot) override;
    Value* cell_column() override;
    void store(std::size_t result, Value* number);
    void prefetch(std::uint32_t slot, int row);

private:
    // Hides from LLVM's strength reduction how an element number came about. It would replace base
    // plus number by one pointer for each plane and row, run out of registers and load the pointers
    // from the stack again and again (1.2 to 1.5 times slower with five species).
    Value* opaque(Value* element) { return builder_.CreateFreeze(element); }

    Value* element(int row, int slice = 0) {
        Value*& moved = elements_[{row, slice}];
        if (!moved) {
            moved = opaque(builder_.CreateAdd(elements_[{0, 0}], frame_.row_step(row, slice)));
        }
        return moved;
    }

    Value* field(std::uint32_t slot, int row, int column, int slice = 0);

    GridFrame& frame_;
    Builder& builder_;
    Value* row_start_;
    /// By row and slice, counted from the vector's own.
    std::map<std::pair<int, int>, Value*> elements_;
    std::map<std::tuple<std::uint32_t, int, int, int>, Value*> loads_;
};

Value* CellLane::field(std::uint32_t slot, int row, int column, int slice) {
    Value*& value = loads_[{slot, row, column, slice}];
    if (!value) {
        llvm::Type* number = frame_.number();
        Value* place = builder_.CreateAdd(element(row, slice), builder_.getInt64(column));
        Value* address = builder_.CreateInBoundsGEP(number, frame_.field_plane(slot), place);
        const int bytes = column == 0 ? frame_.vector_bytes() : frame_.number_bytes();
        value = frame_.mark(
            builder_.CreateAlignedLoad(frame_.vector_of(number), address, alignment(bytes)), slot);
    }
    return value;
}

// The order of the sums is the specification's: ((((N + S) + E) + W) + U) + D. Vectors that lie
// across two cache lines cost this loop less than shifting them together from their aligned
// neighbours.
Value* CellLane::laplacian(std::uint32_t slot) {
    const Stencil stencil = frame_.stencil();
    Value* sum = nullptr;
    const auto add = [&](Value* number) {
        sum = sum ? builder_.CreateFAdd(sum, number) : number;
    };
    if (stencil.y) {
        add(field(slot, -1, 0));
        add(field(slot, 1, 0));
    }
    if (stencil.x) {
        add(field(slot, 0, 1));
        add(field(slot, 0, -1));
    }
    if (stencil.z) {
        add(field(slot, 0, 0, -1));
        add(field(slot, 0, 0, 1));
    }
    Value* own = field(slot);
    Value* count = llvm::ConstantFP::get(own->getType(), 2.0 * stencil.axes());
    return builder_.CreateFSub(sum, builder_.CreateFMul(own, count));
}

Value* CellLane::neighbour(Neighbour at) {
    const Stencil stencil = frame_.stencil();
    return field(at.slot, stencil.y ? at.dy : 0, stencil.x ? at.dx : 0, stencil.z ? at.dz : 0);
}

Value* CellLane::mask(std::uint32_t slot) {
    llvm::Type* byte = builder_.getInt8Ty();
    Value* address = builder_.CreateInBoundsGEP(byte, frame_.mask_plane(slot), element(0));
    llvm::LoadInst* bytes = builder_.CreateAlignedLoad(frame_.vector_of(byte), address,
                                                       alignment(frame_.lanes()));
    return builder_.CreateIsNotNull(frame_.aliases().mark(bytes, 0));
}

Value* CellLane::cell_column() {
    llvm::Type* word = frame_.word();
    Value* first = builder_.CreateTrunc(builder_.CreateSub(element(0), row_start_), word);
    std::vector<llvm::Constant*> counts;
    for (int lane = 0; lane < frame_.lanes(); ++lane) {
        counts.push_back(llvm::ConstantInt::get(word, static_cast<unsigned>(lane)));
    }
    return builder_.CreateAdd(frame_.splat(builder_, first), llvm::ConstantVector::get(counts));
}

void CellLane::store(std::size_t result, Value* number) {
    Value* address = builder_.CreateInBoundsGEP(frame_.number(), frame_.result_plane(result),
                                                element(0));
    frame_.aliases().mark(
        builder_.CreateAlignedStore(number, address, alignment(frame_.vector_bytes())),
        result + 1);
}

// The place may lie behind the plane: a prefetch never faults.
void CellLane::prefetch(std::uint32_t slot, int row) {
    Value* address =
        builder_.CreateGEP(frame_.number(), frame_.field_plane(slot), element(row));
    const auto word = [&](unsigned value) { return builder_.getInt32(value); };
    builder_.CreateIntrinsic(llvm::Intrinsic::prefetch, {builder_.getPtrTy()},
                             {address, word(0), word(3), word(1)});  // To read, to L1, data.
}

/// Builds loops and bodies.
class GridLoops {
public:
    GridLoops(GridFrame& frame, const CellKernel& kernel)
        : frame_(frame),
          kernel_(kernel),
          levels_(levels_of(kernel)),
          lane_(frame, frame.builder(), nullptr),
          scope_(kernel, levels_, Level::call, frame.builder(), lane_, frame.lanes(), nullptr) {
        scope_.emit();
    }

    /// All rows, one after the other. The code begins where `place` writes and leaves it behind
    /// the loop.
    void rows(bool prefetch, Builder& place);

    llvm::BasicBlock* new_block(const char* name) {
        return llvm::BasicBlock::Create(frame_.function().getContext(), name, &frame_.function());
    }
    llvm::InstSimplifyFolder folder() {
        return llvm::InstSimplifyFolder(frame_.function().getDataLayout());
    }

private:
    void columns(bool prefetch, Value* row, Builder& place, llvm::BasicBlock* next);
    void body(CellLane& lane, Builder& place, BodyScope& row_scope);

    GridFrame& frame_;
    const CellKernel& kernel_;
    std::vector<Level> levels_;
    OuterLane lane_;
    BodyScope scope_;
};

void GridLoops::rows(bool prefetch, Builder& place) {
    llvm::BasicBlock* test = new_block("rows");
    llvm::BasicBlock* start = new_block("row");
    llvm::BasicBlock* next = new_block("row_done");
    llvm::BasicBlock* after = new_block("rows_done");
    llvm::BasicBlock* before = place.GetInsertBlock();
    place.CreateBr(test);

    place.SetInsertPoint(test);
    llvm::PHINode* row = place.CreatePHI(place.getInt64Ty(), 2, "row");
    place.CreateCondBr(place.CreateICmpSLT(row, frame_.row_end()), start, after);

    place.SetInsertPoint(start);
    columns(prefetch, row, place, next);

    place.SetInsertPoint(next);
    Value* behind = place.CreateNSWAdd(row, place.getInt64(1));
    place.CreateBr(test);
    row->addIncoming(frame_.row_begin(), before);
    row->addIncoming(behind, next);
    place.SetInsertPoint(after);
}

// `place` is in the block in front of the columns, which is where the values of a row go. It stays
// open while they come: LLVM's folding follows jumps, and cannot bear to find an empty block.
void GridLoops::columns(bool prefetch, Value* row, Builder& place, llvm::BasicBlock* next) {
    llvm::BasicBlock* cells = new_block("cells");
    Value* start = place.CreateNSWMul(row, frame_.stride(), "row_start");
    Value* end = place.CreateNSWAdd(start, frame_.width());
    OuterLane row_lane(frame_, place, row);
    BodyScope row_scope(kernel_, levels_, Level::row, place, row_lane, frame_.lanes(), &scope_);
    row_scope.emit();

    Builder inner(cells, folder());
    llvm::PHINode* element = inner.CreatePHI(inner.getInt64Ty(), 2, "element");
    CellLane lane(frame_, inner, start, element);
    body(lane, inner, row_scope);
    if (prefetch) {
        // What the next row will be the first to touch: its own cells, or those below it.
        for (std::uint32_t slot = 0; slot < kernel_.field_names.size(); ++slot) {
            lane.prefetch(slot, kernel_.reads_neighbours(slot) ? 2 : 1);
        }
    }
    Value* behind = inner.CreateNSWAdd(element, inner.getInt64(frame_.lanes()));
    inner.CreateCondBr(inner.CreateICmpSLT(behind, end), cells, next);
    element->addIncoming(start, place.GetInsertBlock());
    element->addIncoming(behind, cells);
    place.CreateBr(cells);
}

void GridLoops::body(CellLane& lane, Builder& place, BodyScope& row_scope) {
    BodyScope scope(kernel_, levels_, Level::cell, place, lane, frame_.lanes(), &row_scope);
    scope.emit();
    for (std::size_t result = 0; result < kernel_.results.size(); ++result) {
        lane.store(result, scope.number(kernel_.results[result]));
    }
}

/// Writes the loops where `place` is, one or two ways.
void build_loops(GridFrame& frame, GridLoops& loops, const CellKernel& kernel, Builder& place) {
    const int bytes = frame.vector_bytes();
    const bool may_prefetch = frame.stencil().x && frame.stencil().y && bytes >= cache_line / 2;
    if (!may_prefetch || kernel.code.size() > largest_twofold_kernel) {
        loops.rows(may_prefetch && bytes == cache_line, place);
        place.CreateRetVoid();
        return;
    }
    llvm::BasicBlock* wide = loops.new_block("wide");
    llvm::BasicBlock* narrow = loops.new_block("narrow");
    Value* least = place.getInt64(least_width_to_prefetch(bytes));
    place.CreateCondBr(place.CreateICmpSGE(frame.width(), least), wide, narrow);
    for (llvm::BasicBlock* block : {wide, narrow}) {
        place.SetInsertPoint(block);
        loops.rows(block == wide, place);
        place.CreateRetVoid();
    }
}

}  // namespace

llvm::Function* build_grid_function(llvm::Module& module, const CellKernel& kernel,
                                    const GridShape& shape, const std::string& name) {
    llvm::LLVMContext& context = module.getContext();
    llvm::Type* pointer = llvm::PointerType::getUnqual(context);
    llvm::Type* count = llvm::Type::getInt64Ty(context);
    std::vector<llvm::Type*> arguments{pointer, pointer, pointer, pointer,
                                       count,   count,   count,   count};
    if (shape.stencil.z) arguments.insert(arguments.end(), {count, count});
    auto* type = llvm::FunctionType::get(llvm::Type::getVoidTy(context), arguments, false);
    auto* function =
        llvm::Function::Create(type, llvm::GlobalValue::ExternalLinkage, name, module);
    function->setDoesNotThrow();

    // What is needed once goes to the end of the first block while the loops behind it are built;
    // like all blocks that are written to, it is closed last.
    llvm::BasicBlock* entry = llvm::BasicBlock::Create(context, "entry", function);
    llvm::BasicBlock* begin = llvm::BasicBlock::Create(context, "begin", function);
    const llvm::InstSimplifyFolder folder(module.getDataLayout());
    Builder entry_builder(entry, folder);
    GridFrame frame(*function, kernel, shape, entry_builder);
    GridLoops loops(frame, kernel);

    Builder builder(begin, folder);
    build_loops(frame, loops, kernel, builder);
    entry_builder.CreateBr(begin);
    return function;
}

}  // namespace cascade
