// Reads of neighbours on grids, and prefetches.
//
// The innermost loop has the element numbers of the rows above and below in registers. The loop
// needs four registers more than there are planes.
#include "jit/skeleton_grid.h"

#include "jit/skeleton.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace cascade {
namespace {

using llvm::Value;

// While a row of at least this width is computed, the next row is prefetched. On narrower rows the
// processor itself prefetches far enough ahead, and explicit prefetches cost 5 to 10 %. Vectors of
// half a cache line prefetch each line twice, which saves time only if the planes do not fit into
// the caches.
std::int64_t least_width_to_prefetch(int vector_bytes) {
    return vector_bytes == cache_line ? 128 : 1024;
}

// Kernels up to this size get a second loop without prefetches, for narrow planes and for fields in
// a near cache. In larger kernels prefetches had no measurable cost, and compiling the loop twice
// would take time.
constexpr std::size_t largest_twofold_kernel = 64;

/// Distances between rows in elements. Each is computed once.
class RowOffsets {
public:
    explicit RowOffsets(KernelFrame& frame) : frame_(frame) {}

    /// The distance from a row to the row that is `rows` rows and `slices` slices away.
    Value* to(int rows, int slices) {
        Value*& offset = offsets_[{rows, slices}];
        if (!offset) {
            Builder& builder = frame_.builder();
            Value* count = builder.getInt64(rows);
            if (slices != 0) {
                Value* across = builder.CreateMul(frame_.slice_rows(), builder.getInt64(slices));
                count = builder.CreateAdd(across, count);
            }
            offset = builder.CreateMul(frame_.stride(), count);
        }
        return offset;
    }

    /// The distance to the row that is `rows` rows below. It is 0 if the fields are in a near
    /// cache, where prefetches would evict values that are read sooner.
    Value* ahead(int rows) {
        Value*& offset = ahead_[rows];
        if (!offset) {
            Builder& builder = frame_.builder();
            Value* is_far = builder.CreateICmpEQ(frame_.is_near(), builder.getInt64(0));
            offset = builder.CreateSelect(is_far, to(rows, 0), builder.getInt64(0));
        }
        return offset;
    }

private:
    KernelFrame& frame_;
    std::map<std::pair<int, int>, Value*> offsets_;
    std::map<int, Value*> ahead_;
};

/// A read by a vector of cells: a field, and the numbers of rows, columns and slices from the
/// vector to the cells that are read.
using Reading = std::tuple<FieldSlot, int, int, int>;

/// All different reads of a kernel.
std::set<Reading> readings_of(const CellKernel& kernel, Stencil stencil) {
    std::set<Reading> readings;
    for (const Instruction& instruction : kernel.code) {
        if (instruction.op == Op::neighbour) {
            const Neighbour at = Neighbour::of(instruction.slot());
            readings.emplace(at.slot, stencil.y ? at.dy : 0, stencil.x ? at.dx : 0,
                             stencil.z ? at.dz : 0);
        } else if (instruction.op == Op::field) {
            readings.emplace(instruction.field(), 0, 0, 0);
        } else if (instruction.op == Op::laplacian) {
            const FieldSlot slot = instruction.field();
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

// In kernels with more operations per load than this, loads are not the limit, so shifting saves no
// time. With 4.4 operations per load (chemotaxis), shifting costs 3 %. With at most 3, it saves 2
// to 8 %.
constexpr std::size_t most_operations_a_load = 4;

// The largest number of shifted fields. Each takes one register of the loop.
constexpr std::size_t most_shifted_fields = 8;

/// The fields whose eastern neighbours are not loaded. A shift makes the vector of eastern
/// neighbours from the cells' own vector and the next one, which stays in a register until the loop
/// reaches it. Western neighbours are loaded, because shifts for them would take two more
/// operations of the arithmetic units.
std::set<FieldSlot> shifted_fields(const KernelFrame& frame) {
    std::set<FieldSlot> fields;
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

/// The cells of the next row that the loop over rows prefetches.
enum class Fetching { nothing, ahead, unless_near };

/// Values shared by rows that are computed together: the row below a row of the group is the
/// group's next row. Keys are row indices, counted from the group's first row.
struct CommonReadings {
    std::map<std::pair<int, int>, Value*> elements;  ///< By row and by slice.
    std::map<Reading, Value*> loads;
    std::map<int, Value*> fetched;  ///< By row. Not used if the fields are in a near cache.
};

/// The values that the cells of a grid read.
class GridSources final : public CellSources {
public:
    /// `row` is the index of the vector's row in the group of rows that are computed together.
    GridSources(KernelFrame& frame, Builder& builder, const CellVector& vector, RowOffsets& offsets,
                const std::set<FieldSlot>& shifted, CommonReadings& common, int row)
        : CellSources(frame, builder, vector),
          offsets_(offsets),
          shifted_(shifted),
          common_(common),
          row_(row) {
        Value*& own = common_.elements[{row, 0}];
        if (own) {
            element_ = own;
        } else {
            own = element_;
        }
    }

    Value* field(FieldSlot slot) override;
    Value* laplacian(FieldSlot slot) override;
    Value* neighbour(Neighbour at) override;
    void prefetch(FieldSlot slot, int rows, Fetching fetching);

private:
    Value* element(int row, int slice = 0) {
        Value*& moved = common_.elements[{row_ + row, slice}];
        if (!moved) moved = opaque(builder_.CreateAdd(element_, offsets_.to(row, slice)));
        return moved;
    }

    Value* load(Builder& builder, FieldSlot slot, Value* element, int column) const;
    Value* beside(FieldSlot slot, int row, int column, int slice = 0);
    Value* east(FieldSlot slot);
    Value* without_own(Value* sum, Value* own);

    RowOffsets& offsets_;
    const std::set<FieldSlot>& shifted_;
    std::map<FieldSlot, Value*> carried_;  ///< The vector's own values of shifted fields.
    CommonReadings& common_;
    int row_;
};

Value* GridSources::load(Builder& builder, FieldSlot slot, Value* element, int column) const {
    llvm::Type* number = frame_.number();
    Value* beside = builder.CreateAdd(element, builder.getInt64(column));
    Value* address = builder.CreateInBoundsGEP(number, frame_.field_plane(slot), beside);
    const bool is_aligned = column % frame_.lanes() == 0;
    const int bytes = is_aligned ? frame_.vector_bytes() : frame_.number_bytes();
    return frame_.mark(
        builder.CreateAlignedLoad(frame_.vector_of(number), address, alignment(bytes)), slot);
}

Value* GridSources::field(FieldSlot slot) {
    if (!shifted_.contains(slot)) return beside(slot, 0, 0);
    Value*& own = carried_[slot];
    if (!own) {
        own = vector_.carried->take(slot, [&](Builder& outside) {
            return load(outside, slot, vector_.first, 0);
        });
        vector_.carried->give(slot, load(builder_, slot, element_, frame_.lanes()));
    }
    return own;
}

Value* GridSources::beside(FieldSlot slot, int row, int column, int slice) {
    const bool is_own = row == 0 && column == 0 && slice == 0;
    if (is_own && shifted_.contains(slot)) return field(slot);
    Value*& value = common_.loads[{slot, row_ + row, column, slice}];
    if (!value) {
        const bool is_east = row == 0 && column == 1 && slice == 0;
        value = is_east && shifted_.contains(slot)
                    ? east(slot)
                    : load(builder_, slot, element(row, slice), column);
    }
    return value;
}

Value* GridSources::east(FieldSlot slot) {
    Value* own = field(slot);
    llvm::SmallVector<int, 16> lanes;
    for (int lane = 1; lane <= frame_.lanes(); ++lane) lanes.push_back(lane);
    return builder_.CreateShuffleVector(own, vector_.carried->given(slot), lanes);
}

// Adds in the order of the specification: ((((N + S) + E) + W) + U) + D.
Value* GridSources::laplacian(FieldSlot slot) {
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

// The sum minus 2, 4 or 6 times the cell's own value. Multiples by 2 and 4 are exact unless they
// overflow, so rounding once gives the same result as rounding twice. The specification demands a
// single rounding even if the multiple overflows, so that all processors agree. The multiple by 6
// is rounded before it is subtracted.
Value* GridSources::without_own(Value* sum, Value* own) {
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

Value* GridSources::neighbour(Neighbour at) {
    const Stencil stencil = frame_.stencil();
    return beside(at.slot, stencil.y ? at.dy : 0, stencil.x ? at.dx : 0, stencil.z ? at.dz : 0);
}

// The prefetched address may be beyond the plane.
void GridSources::prefetch(FieldSlot slot, int rows, Fetching fetching) {
    Value* ahead = nullptr;
    if (fetching == Fetching::ahead) {
        ahead = element(rows);
    } else {
        Value*& fetched = common_.fetched[row_ + rows];
        if (!fetched) fetched = opaque(builder_.CreateAdd(element_, offsets_.ahead(rows)));
        ahead = fetched;
    }
    frame_.prefetch(builder_, builder_.CreateGEP(frame_.number(), frame_.field_plane(slot), ahead));
}

/// Fills the halo columns of a row whose cells have been written, if the arguments name columns.
/// This takes little time, because the cells are in the cache or will soon be there, and the
/// processor copies them while it computes later rows.
void fill_columns(KernelFrame& frame, Value* row_start, Builder& builder) {
    llvm::BasicBlock* fill = frame.new_block("fill_columns");
    llvm::BasicBlock* filled = frame.new_block("columns_filled");
    Value* is_asked = builder.CreateICmpSGE(frame.left_column(), builder.getInt64(0));
    builder.CreateCondBr(is_asked, fill, filled);
    builder.SetInsertPoint(fill);
    const auto bytes = alignment(frame.number_bytes());
    const auto address = [&](std::size_t result, Value* column) {
        return builder.CreateInBoundsGEP(frame.number(), frame.result_plane(result),
                                         builder.CreateNSWAdd(row_start, column));
    };
    for (std::size_t k = 0; k < frame.kernel().results.size(); ++k) {
        const auto copy = [&](Value* from, Value* to) {
            Value* cell = builder.CreateAlignedLoad(frame.number(), address(k, from), bytes);
            builder.CreateAlignedStore(cell, address(k, to), bytes);
        };
        copy(frame.left_column(), builder.getInt64(-1));
        copy(frame.right_column(), frame.column_end());
    }
    builder.CreateBr(filled);
    builder.SetInsertPoint(filled);
}

/// Whether two rows are computed at a time. Two rows need fewer loads, because each of them is a
/// neighbour of the other. With vectors of a whole cache line this saves less time, because the
/// processor then has enough units for all loads.
bool takes_two_rows(const KernelFrame& frame) {
    if (frame.vector_bytes() != cache_line / 2) return false;
    if (frame.kernel().code.size() > largest_twofold_kernel) return false;
    const std::set<Reading> readings = readings_of(frame.kernel(), frame.stencil());
    return std::any_of(readings.begin(), readings.end(),
                       [](const Reading& each) { return std::get<1>(each) != 0; });
}

/// Writes the loops over all rows. While a row is computed, the loops may prefetch those cells that
/// the next row will be the first to read: its own cells or, in fields that are read at neighbours,
/// the cells of the row below it.
void build_rows(KernelFrame& frame, KernelLoops& loops, RowOffsets& offsets,
                const std::set<FieldSlot>& shifted, Fetching fetching, Builder& builder) {
    std::map<FieldSlot, int> rows_ahead;
    for (const auto& [slot, row, column, slice] : readings_of(frame.kernel(), frame.stencil())) {
        rows_ahead[slot] = frame.kernel().reads_neighbours(slot) ? 2 : 1;
    }
    const auto write_vectors = [&](llvm::ArrayRef<CellVector> vectors, Builder& inner) {
        CommonReadings common;
        for (int row = 0; const CellVector& vector : vectors) {
            GridSources cells(frame, inner, vector, offsets, shifted, common, row++);
            loops.body(cells, inner, vector);
            if (fetching == Fetching::nothing) continue;
            const int further = static_cast<int>(vectors.size()) - 1;
            for (const auto& [slot, rows] : rows_ahead) {
                cells.prefetch(slot, rows + further, fetching);
            }
        }
    };
    const auto write_row_end = [&](Value* row_start, Builder& after) {
        if (frame.shape().fills_columns) fill_columns(frame, row_start, after);
    };
    Value* row = frame.row_begin();
    if (takes_two_rows(frame)) row = loops.rows(builder, row, 2, write_vectors, write_row_end);
    loops.rows(builder, row, 1, write_vectors, write_row_end);
    builder.CreateRetVoid();
}

/// Writes the loops over all rows. For small kernels, also writes a second version of the loops
/// without prefetches.
void build_loops(KernelFrame& frame, KernelLoops& loops, Builder& builder) {
    RowOffsets offsets(frame);
    const std::set<FieldSlot> shifted = shifted_fields(frame);
    const int bytes = frame.vector_bytes();
    const bool may_prefetch = frame.stencil().x && frame.stencil().y && bytes >= cache_line / 2;
    if (!may_prefetch || frame.kernel().code.size() > largest_twofold_kernel) {
        const bool prefetch = may_prefetch && bytes == cache_line;
        build_rows(frame, loops, offsets, shifted,
                   prefetch ? Fetching::unless_near : Fetching::nothing, builder);
        return;
    }
    llvm::BasicBlock* wide = frame.new_block("wide");
    llvm::BasicBlock* narrow = frame.new_block("narrow");
    Value* least = builder.getInt64(least_width_to_prefetch(bytes));
    Value* is_far = builder.CreateICmpEQ(frame.is_near(), builder.getInt64(0));
    Value* width = builder.CreateSub(frame.column_end(), frame.column_begin());
    builder.CreateCondBr(builder.CreateAnd(builder.CreateICmpSGE(width, least), is_far), wide,
                         narrow);
    for (llvm::BasicBlock* block : {wide, narrow}) {
        builder.SetInsertPoint(block);
        build_rows(frame, loops, offsets, shifted,
                   block == wide ? Fetching::ahead : Fetching::nothing, builder);
    }
}

}  // namespace

llvm::Function* build_grid_function(llvm::Module& module, const KernelPart& part,
                                    const KernelShape& shape, const std::string& name) {
    const std::size_t count = shape.stencil.z || shape.fills_columns ? 3 : 1;
    const std::vector<llvm::Type*> extra(count, llvm::Type::getInt64Ty(module.getContext()));
    return build_function(module, part, shape, name, extra, build_loops);
}

}  // namespace cascade
