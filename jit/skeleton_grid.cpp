// Neighbours on grids, and prefetches.
//
// With the element numbers of the rows above and below, the innermost loop needs as many registers
// as there are planes, plus four.
#include "jit/skeleton_grid.h"

#include "jit/skeleton.h"

#include <map>
#include <tuple>
#include <utility>

namespace cascade {
namespace {

using llvm::Value;

// Rows of at least this width are computed while the rows behind them are prefetched. On narrower
// ones the processor sees far enough ahead by itself, and prefetching costs 5 to 10 %. Vectors of
// half a cache line prefetch each line twice, which pays only for planes that leave the caches.
std::int64_t least_width_to_prefetch(int vector_bytes) {
    return vector_bytes == cache_line ? 128 : 1024;
}

// Kernels up to this size get a loop without prefetching for narrow planes; in larger ones the
// prefetches cost nothing that could be noticed, and compiling the loop twice would.
constexpr std::size_t largest_twofold_kernel = 64;

/// Elements from a row to others, computed once.
class RowSteps {
public:
    explicit RowSteps(KernelFrame& frame) : frame_(frame) {}

    /// To the row that is `rows` rows and `slices` slices away.
    Value* to(int rows, int slices) {
        Value*& step = steps_[{rows, slices}];
        if (!step) {
            Builder& builder = frame_.builder();
            Value* count = builder.getInt64(rows);
            if (slices != 0) {
                Value* across = builder.CreateMul(frame_.slice_rows(), builder.getInt64(slices));
                count = builder.CreateAdd(across, count);
            }
            step = builder.CreateMul(frame_.stride(), count);
        }
        return step;
    }

private:
    KernelFrame& frame_;
    std::map<std::pair<int, int>, Value*> steps_;
};

class GridLane final : public CellLane {
public:
    GridLane(KernelFrame& frame, Builder& builder, const VectorPlace& place, RowSteps& steps)
        : CellLane(frame, builder, place), steps_(steps) {
        elements_[{0, 0}] = element_;
    }

    Value* laplacian(std::uint32_t slot) override;
    Value* neighbour(Neighbour at) override;
    void prefetch(std::uint32_t slot, int row);

private:
    Value* element(int row, int slice = 0) {
        Value*& moved = elements_[{row, slice}];
        if (!moved) moved = opaque(builder_.CreateAdd(element_, steps_.to(row, slice)));
        return moved;
    }

    Value* beside(std::uint32_t slot, int row, int column, int slice = 0);

    RowSteps& steps_;
    /// By row and slice, counted from the vector's own.
    std::map<std::pair<int, int>, Value*> elements_;
    std::map<std::tuple<std::uint32_t, int, int, int>, Value*> loads_;
};

Value* GridLane::beside(std::uint32_t slot, int row, int column, int slice) {
    if (row == 0 && column == 0 && slice == 0) return field(slot);
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
Value* GridLane::laplacian(std::uint32_t slot) {
    const Stencil stencil = frame_.stencil();
    Value* sum = nullptr;
    const auto add = [&](Value* number) {
        sum = sum ? builder_.CreateFAdd(sum, number) : number;
    };
    if (stencil.y) {
        add(beside(slot, -1, 0));
        add(beside(slot, 1, 0));
    }
    if (stencil.x) {
        add(beside(slot, 0, 1));
        add(beside(slot, 0, -1));
    }
    if (stencil.z) {
        add(beside(slot, 0, 0, -1));
        add(beside(slot, 0, 0, 1));
    }
    Value* own = field(slot);
    Value* count = llvm::ConstantFP::get(own->getType(), 2.0 * stencil.axes());
    return builder_.CreateFSub(sum, builder_.CreateFMul(own, count));
}

Value* GridLane::neighbour(Neighbour at) {
    const Stencil stencil = frame_.stencil();
    return beside(at.slot, stencil.y ? at.dy : 0, stencil.x ? at.dx : 0, stencil.z ? at.dz : 0);
}

// The place may lie behind the plane.
void GridLane::prefetch(std::uint32_t slot, int row) {
    frame_.prefetch(builder_,
                    builder_.CreateGEP(frame_.number(), frame_.field_plane(slot), element(row)));
}

/// All rows, with or without what the next row will be the first to touch: its own cells, or those
/// below it.
void build_rows(KernelFrame& frame, KernelLoops& loops, RowSteps& steps, bool prefetch,
                Builder& place) {
    const CellKernel& kernel = frame.kernel();
    loops.rows(place, [&](const VectorPlace& at, Builder& builder, BodyScope& row_scope) {
        GridLane lane(frame, builder, at, steps);
        loops.body(lane, builder, row_scope);
        for (std::uint32_t slot = 0; prefetch && slot < kernel.field_names.size(); ++slot) {
            lane.prefetch(slot, kernel.reads_neighbours(slot) ? 2 : 1);
        }
    });
    place.CreateRetVoid();
}

/// Writes the loops where `place` is, one or two ways.
void build_loops(KernelFrame& frame, KernelLoops& loops, Builder& place) {
    RowSteps steps(frame);
    const int bytes = frame.vector_bytes();
    const bool may_prefetch = frame.stencil().x && frame.stencil().y && bytes >= cache_line / 2;
    if (!may_prefetch || frame.kernel().code.size() > largest_twofold_kernel) {
        build_rows(frame, loops, steps, may_prefetch && bytes == cache_line, place);
        return;
    }
    llvm::BasicBlock* wide = frame.new_block("wide");
    llvm::BasicBlock* narrow = frame.new_block("narrow");
    Value* least = place.getInt64(least_width_to_prefetch(bytes));
    place.CreateCondBr(place.CreateICmpSGE(frame.width(), least), wide, narrow);
    for (llvm::BasicBlock* block : {wide, narrow}) {
        place.SetInsertPoint(block);
        build_rows(frame, loops, steps, block == wide, place);
    }
}

}  // namespace

llvm::Function* build_grid_function(llvm::Module& module, const CellKernel& kernel,
                                    const KernelShape& shape, const std::string& name) {
    std::vector<llvm::Type*> further;
    if (shape.stencil.z) further.assign(2, llvm::Type::getInt64Ty(module.getContext()));
    return build_function(module, kernel, shape, name, further, build_loops);
}

}  // namespace cascade
