// Neighbours on grids, and prefetches.
//
// With the element numbers of the rows above and below, the innermost loop needs as many registers
// as there are planes, plus four.
#include "jit/skeleton_grid.h"

#include "jit/skeleton.h"

#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace cascade {
namespace {

using llvm::Value;

// Rows of at least this width are computed while the rows after them are prefetched. On narrower
// ones the processor sees far enough ahead by itself, and prefetching costs 5 to 10 %. Vectors of
// half a cache line prefetch each line twice, which pays only for planes that leave the caches.
std::int64_t least_width_to_prefetch(int vector_bytes) {
    return vector_bytes == cache_line ? 128 : 1024;
}

// Kernels up to this size get a loop without prefetching, for narrow planes and for what is in a
// near cache; in larger ones the prefetches cost nothing that could be noticed, and compiling the
// loop twice would.
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

    /// To the row that is `rows` rows below; to the own one where what is there is near already,
    /// for fetching it would drive out what is to be read sooner.
    Value* ahead(int rows) {
        Value*& step = ahead_[rows];
        if (!step) {
            Builder& builder = frame_.builder();
            Value* is_far = builder.CreateICmpEQ(frame_.is_near(), builder.getInt64(0));
            step = builder.CreateSelect(is_far, to(rows, 0), builder.getInt64(0));
        }
        return step;
    }

private:
    KernelFrame& frame_;
    std::map<std::pair<int, int>, Value*> steps_;
    std::map<int, Value*> ahead_;
};

/// What a vector of cells reads: a field, and how many rows, columns and slices away.
using Reading = std::tuple<std::uint32_t, int, int, int>;

/// All that a kernel reads, each once.
std::set<Reading> readings_of(const CellKernel& kernel, Stencil stencil) {
    std::set<Reading> readings;
    for (const Instruction& instruction : kernel.code) {
        if (instruction.op == Op::neighbour) {
            const Neighbour at = Neighbour::of(instruction.slot());
            readings.emplace(at.slot, stencil.y ? at.dy : 0, stencil.x ? at.dx : 0,
                             stencil.z ? at.dz : 0);
        } else if (instruction.op == Op::field) {
            readings.emplace(instruction.slot(), 0, 0, 0);
        } else if (instruction.op == Op::laplacian) {
            const std::uint32_t slot = instruction.slot();
            readings.emplace(slot, 0, 0, 0);
            for (const int way : {-1, 1}) {
                if (stencil.y) readings.emplace(slot, way, 0, 0);
                if (stencil.x) readings.emplace(slot, 0, way, 0);
                if (stencil.z) readings.emplace(slot, 0, 0, way);
            }
        }
    }
    return readings;
}

// Kernels of more operations than this for each vector that they read have time for their loads:
// with 4.4 (chemotaxis) shifting cost 3 %, with 3 and fewer it saves 2 to 8 %.
constexpr std::size_t most_operations_a_load = 4;

// Each takes a register from the loop.
constexpr std::size_t most_shifted_fields = 8;

/// The fields whose eastern neighbours are shifted together from the own vector and the next one,
/// which the loop then has already when it comes there. The western ones are loaded: shifted as
/// well, they would take the time of two more operations from the same units that compute.
std::set<std::uint32_t> shifted_fields(const KernelFrame& frame) {
    std::set<std::uint32_t> fields;
    if (!frame.shape().is_short_of_loads || frame.vector_bytes() != cache_line) return fields;
    const std::set<Reading> readings = readings_of(frame.kernel(), frame.stencil());
    std::size_t operations = 0;
    for (const Instruction& instruction : frame.kernel().code) {
        constexpr std::size_t of_laplacian = 6;
        if (instruction.op == Op::laplacian) operations += of_laplacian;
        if (info(instruction.op).arity > 0) ++operations;
    }
    if (operations > most_operations_a_load * readings.size()) return fields;
    for (const auto& [slot, row, column, slice] : readings) {
        if (row != 0 || slice != 0 || column != 1) continue;
        if (readings.contains({slot, 0, 0, 0})) fields.insert(slot);
    }
    if (fields.size() > most_shifted_fields) fields.clear();
    return fields;
}

/// What a loop over rows fetches for the next one.
enum class Fetching { nothing, ahead, unless_near };

class GridLane final : public CellLane {
public:
    GridLane(KernelFrame& frame, Builder& builder, const VectorPlace& place, RowSteps& steps,
             const std::set<std::uint32_t>& shifted)
        : CellLane(frame, builder, place), steps_(steps), shifted_(shifted) {
        elements_[{0, 0}] = element_;
    }

    Value* field(std::uint32_t slot) override;
    Value* laplacian(std::uint32_t slot) override;
    Value* neighbour(Neighbour at) override;
    void prefetch(std::uint32_t slot, int rows, Fetching fetching);

private:
    Value* element(int row, int slice = 0) {
        Value*& moved = elements_[{row, slice}];
        if (!moved) moved = opaque(builder_.CreateAdd(element_, steps_.to(row, slice)));
        return moved;
    }

    Value* load(Builder& builder, std::uint32_t slot, Value* element, int column) const;
    Value* beside(std::uint32_t slot, int row, int column, int slice = 0);
    Value* east(std::uint32_t slot);
    Value* without_own(Value* sum, Value* own);

    RowSteps& steps_;
    const std::set<std::uint32_t>& shifted_;
    std::map<std::uint32_t, Value*> carried_;  ///< Own vectors of shifted fields.
    /// By row and slice, counted from the vector's own.
    std::map<std::pair<int, int>, Value*> elements_;
    std::map<Reading, Value*> loads_;
    std::map<int, Value*> fetched_;  ///< By row, unless near.
};

Value* GridLane::load(Builder& builder, std::uint32_t slot, Value* element, int column) const {
    llvm::Type* number = frame_.number();
    Value* place = builder.CreateAdd(element, builder.getInt64(column));
    Value* address = builder.CreateInBoundsGEP(number, frame_.field_plane(slot), place);
    const bool is_aligned = column % frame_.lanes() == 0;
    const int bytes = is_aligned ? frame_.vector_bytes() : frame_.number_bytes();
    return frame_.mark(
        builder.CreateAlignedLoad(frame_.vector_of(number), address, alignment(bytes)), slot);
}

Value* GridLane::field(std::uint32_t slot) {
    if (!shifted_.contains(slot)) return CellLane::field(slot);
    Value*& own = carried_[slot];
    if (!own) {
        own = place_.carried->take(slot, [&](Builder& outside) {
            return load(outside, slot, place_.row_start, 0);
        });
        place_.carried->give(slot, load(builder_, slot, element_, frame_.lanes()));
    }
    return own;
}

Value* GridLane::beside(std::uint32_t slot, int row, int column, int slice) {
    if (row == 0 && column == 0 && slice == 0) return field(slot);
    Value*& value = loads_[{slot, row, column, slice}];
    if (!value) {
        const bool is_east = row == 0 && column == 1 && slice == 0;
        value = is_east && shifted_.contains(slot)
                    ? east(slot)
                    : load(builder_, slot, element(row, slice), column);
    }
    return value;
}

Value* GridLane::east(std::uint32_t slot) {
    Value* own = field(slot);
    llvm::SmallVector<int, 16> lanes;
    for (int lane = 1; lane <= frame_.lanes(); ++lane) lanes.push_back(lane);
    return builder_.CreateShuffleVector(own, place_.carried->given(slot), lanes);
}

// The order of the sums is the specification's: ((((N + S) + E) + W) + U) + D.
Value* GridLane::laplacian(std::uint32_t slot) {
    const Stencil stencil = frame_.stencil();
    Value* sum = nullptr;
    const auto add = [&](Value* number) { sum = sum ? builder_.CreateFAdd(sum, number) : number; };
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
    return without_own(sum, field(slot));
}

// The sum minus 2, 4 or 6 times the own value. 2 and 4 times a number are exact but for overflow,
// so that one rounding is as good as two; the specification has one, and gives numbers whose
// fourfold would overflow the same way on all processors. Sixfold is rounded.
Value* GridLane::without_own(Value* sum, Value* own) {
    llvm::Type* type = own->getType();
    const auto number = [&](double value) { return llvm::ConstantFP::get(type, value); };
    const double count = 2.0 * frame_.stencil().axes();
    const auto subtract = [&] {
        return builder_.CreateFSub(sum, builder_.CreateFMul(own, number(count)));
    };
    if (frame_.stencil().axes() == 3) return subtract();
    if (frame_.shape().has_multiply_add) {
        return builder_.CreateIntrinsic(llvm::Intrinsic::fma, {type}, {own, number(-count), sum});
    }
    const double quarter = frame_.number()->isFloatTy()
                               ? double{std::numeric_limits<float>::max()} / 4
                               : std::numeric_limits<double>::max() / 4;
    Value* size = builder_.CreateUnaryIntrinsic(llvm::Intrinsic::fabs, own);
    Value* part = builder_.CreateFSub(builder_.CreateFMul(sum, number(1 / count)), own);
    return builder_.CreateSelect(builder_.CreateFCmpOGT(size, number(quarter)),
                                 builder_.CreateFMul(part, number(count)), subtract());
}

Value* GridLane::neighbour(Neighbour at) {
    const Stencil stencil = frame_.stencil();
    return beside(at.slot, stencil.y ? at.dy : 0, stencil.x ? at.dx : 0, stencil.z ? at.dz : 0);
}

// The place may lie after the plane.
void GridLane::prefetch(std::uint32_t slot, int rows, Fetching fetching) {
    Value* place = nullptr;
    if (fetching == Fetching::ahead) {
        place = element(rows);
    } else {
        Value*& fetched = fetched_[rows];
        if (!fetched) fetched = opaque(builder_.CreateAdd(element_, steps_.ahead(rows)));
        place = fetched;
    }
    frame_.prefetch(builder_, builder_.CreateGEP(frame_.number(), frame_.field_plane(slot), place));
}

/// All rows, with or without what the next row will be the first to touch: its own cells, or those
/// below it.
void build_rows(KernelFrame& frame, KernelLoops& loops, RowSteps& steps,
                const std::set<std::uint32_t>& shifted, Fetching fetching, Builder& place) {
    const CellKernel& kernel = frame.kernel();
    loops.rows(place, [&](const VectorPlace& at, Builder& builder, BodyScope& row_scope) {
        GridLane lane(frame, builder, at, steps, shifted);
        loops.body(lane, builder, row_scope);
        if (fetching == Fetching::nothing) return;
        for (std::uint32_t slot = 0; slot < kernel.field_names.size(); ++slot) {
            lane.prefetch(slot, kernel.reads_neighbours(slot) ? 2 : 1, fetching);
        }
    });
    place.CreateRetVoid();
}

/// Writes the loops where `place` is, one or two ways.
void build_loops(KernelFrame& frame, KernelLoops& loops, Builder& place) {
    RowSteps steps(frame);
    const std::set<std::uint32_t> shifted = shifted_fields(frame);
    const int bytes = frame.vector_bytes();
    const bool may_prefetch = frame.stencil().x && frame.stencil().y && bytes >= cache_line / 2;
    if (!may_prefetch || frame.kernel().code.size() > largest_twofold_kernel) {
        const bool prefetch = may_prefetch && bytes == cache_line;
        build_rows(frame, loops, steps, shifted,
                   prefetch ? Fetching::unless_near : Fetching::nothing, place);
        return;
    }
    llvm::BasicBlock* wide = frame.new_block("wide");
    llvm::BasicBlock* narrow = frame.new_block("narrow");
    Value* least = place.getInt64(least_width_to_prefetch(bytes));
    Value* is_far = place.CreateICmpEQ(frame.is_near(), place.getInt64(0));
    place.CreateCondBr(place.CreateAnd(place.CreateICmpSGE(frame.width(), least), is_far), wide,
                       narrow);
    for (llvm::BasicBlock* block : {wide, narrow}) {
        place.SetInsertPoint(block);
        build_rows(frame, loops, steps, shifted,
                   block == wide ? Fetching::ahead : Fetching::nothing, place);
    }
}

}  // namespace

llvm::Function* build_grid_function(llvm::Module& module, const CellKernel& kernel,
                                    const KernelShape& shape, const std::string& name) {
    const std::vector<llvm::Type*> further(shape.stencil.z ? 3 : 1,
                                           llvm::Type::getInt64Ty(module.getContext()));
    return build_function(module, kernel, shape, name, further, build_loops);
}

}  // namespace cascade
