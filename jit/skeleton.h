// The common parts of all kernels' functions: their arguments, the loops over rows and over the
// vectors of a row, loads from the cells themselves, and stores. Reads of other cells are in
// skeleton_grid.cpp and skeleton_linked.cpp.
//
// Internal to jit/*.cpp. The first arguments of all functions (double for float in kernels of
// binary64):
//
//     const float *const *fields, const unsigned char *const *masks,
//     const float *uniforms, float *const *results,
//     int64_t column_begin, int64_t column_end, int64_t stride, int64_t row_begin, int64_t row_end
//
// Pointers are to cell (0, 0, 0) of planes in the layout of PlaneLayout. Rows are rows of memory.
// Columns [column_begin, column_end) of rows [row_begin, row_end) are computed in vectors of
// `lanes` cells. `column_begin` is a multiple of PlaneLayout::row_pad. The last vector of a row may
// run beyond `column_end`, at most to the next multiple.
#pragma once

#include "jit/alias_scopes.h"
#include "jit/carried_vectors.h"
#include "jit/emit_body.h"
#include "ir/kernel_parts.h"
#include "jit/kernel_shape.h"

#include <llvm/ADT/STLFunctionalExtras.h>
#include <llvm/IR/Module.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace cascade {

inline llvm::Align alignment(int bytes) { return llvm::Align(static_cast<std::uint64_t>(bytes)); }

constexpr int cache_line = 64;  ///< Bytes.

/// The data shared by all rows and vectors: the arguments and the addresses of planes.
class KernelFrame {
public:
    /// `builder` writes to the block before the loops.
    KernelFrame(llvm::Function& function, const KernelPart& part, const KernelShape& shape,
                Builder& builder)
        : function_(function),
          part_(part),
          shape_(shape),
          builder_(builder),
          aliases_(function.getContext(), part.results.size()) {}

    llvm::Function& function() { return function_; }
    const CellKernel& kernel() const { return part_.kernel; }
    const KernelPart& part() const { return part_; }
    Stencil stencil() const { return shape_.stencil; }
    const KernelShape& shape() const { return shape_; }
    int lanes() const { return shape_.lanes; }
    int number_bytes() const { return static_cast<int>(bytes_of(kernel().precision)); }
    int vector_bytes() const { return lanes() * number_bytes(); }
    llvm::Type* number() const { return number_type(builder_, kernel().precision); }
    llvm::Type* word() const { return word_type(builder_, kernel().precision); }
    Builder& builder() { return builder_; }
    const AliasScopes& aliases() const { return aliases_; }

    llvm::Value* column_begin() { return function_.getArg(4); }
    llvm::Value* column_end() { return function_.getArg(5); }
    llvm::Value* stride() { return function_.getArg(6); }
    llvm::Value* row_begin() { return function_.getArg(7); }
    llvm::Value* row_end() { return function_.getArg(8); }
    /// An argument after the common ones, counted from 0.
    llvm::Value* extra_argument(unsigned number) {
        return function_.getArg(shared_arguments + number);
    }
    // Arguments for grids (skeleton_grid.h).
    llvm::Value* is_near() { return extra_argument(0); }
    bool has_slices() const { return stencil().z; }
    llvm::Value* slice_rows() { return extra_argument(1); }
    llvm::Value* slice() { return extra_argument(2); }
    llvm::Value* left_column() { return extra_argument(1); }
    llvm::Value* right_column() { return extra_argument(2); }

    // Addresses of planes, loaded once.
    llvm::Value* field_plane(FieldSlot slot) { return plane(0, slot.index()); }
    llvm::Value* mask_plane(MaskSlot slot) { return plane(1, slot.index()); }
    llvm::Value* result_plane(std::size_t slot) { return plane(3, part_.results[slot]); }

    llvm::Type* vector_of(llvm::Type* element) const {
        return llvm::FixedVectorType::get(element, static_cast<unsigned>(lanes()));
    }
    llvm::Value* splat(Builder& builder, llvm::Value* element) const {
        return builder.CreateVectorSplat(static_cast<unsigned>(lanes()), element);
    }

    /// Tells LLVM that no result overlaps the field, if it is read at neighbours.
    template <typename Load>
    Load* mark(Load* load, FieldSlot slot) const {
        return kernel().reads_neighbours(slot) ? aliases_.mark(load, 0) : load;
    }

    llvm::Value* uniform(UniformSlot slot);
    /// A constant that is loaded from a variable of the module, so that LLVM cannot fold it.
    llvm::Value* hidden(std::uint64_t word);

    /// Prefetches a cache line. Any address will do, because a prefetch never faults.
    void prefetch(Builder& builder, llvm::Value* address) const;

    llvm::BasicBlock* new_block(const char* name) {
        return llvm::BasicBlock::Create(function_.getContext(), name, &function_);
    }
    llvm::InstSimplifyFolder folder() {
        return llvm::InstSimplifyFolder(function_.getDataLayout());
    }

private:
    static constexpr unsigned shared_arguments = 9;

    llvm::Value* plane(unsigned table, std::size_t slot);

    llvm::Function& function_;
    const KernelPart& part_;
    KernelShape shape_;
    Builder& builder_;
    AliasScopes aliases_;
    std::map<std::pair<unsigned, std::size_t>, llvm::Value*> planes_;
};

/// The vector of cells that one execution of the innermost loop computes. All planes share one
/// layout, so an element number serves all of them: an access is a plane's address plus this
/// number, an addressing mode of the processor.
struct CellVector {
    llvm::Value* row = nullptr;         ///< Its number.
    llvm::Value* row_start = nullptr;   ///< Element number of the row's first cell,
    llvm::Value* first = nullptr;       ///< and of the first computed cell.
    llvm::Value* element = nullptr;     ///< Element number of the vector's first cell.
    CarriedVectors* carried = nullptr;  ///< Values from this vector to the next.
    BodyScope* row_scope = nullptr;     ///< Values common to the row's cells.
};

/// The values that the cells of a vector read of themselves, and their results.
class CellSources : public Sources {
public:
    CellSources(KernelFrame& frame, Builder& builder, const CellVector& vector)
        : frame_(frame), builder_(builder), vector_(vector), element_(opaque(vector.element)) {}

    llvm::Value* field(FieldSlot slot) override;
    llvm::Value* mask(MaskSlot slot) override;
    llvm::Value* cell_column() override;
    void store(std::size_t result, llvm::Value* number);
    /// Writes a loop over the links of the cells, and defines its reductions in their scope.
    virtual void reduce_links(BodyScope& cells, const LinkLoop& loop);

protected:
    // Hides from LLVM's strength reduction how an element number was computed. It would replace
    // base plus number by one pointer for each plane and row, run out of registers and load the
    // pointers from the stack again and again (1.2 to 1.5 times slower with five species).
    llvm::Value* opaque(llvm::Value* element) { return builder_.CreateFreeze(element); }

    KernelFrame& frame_;
    Builder& builder_;
    CellVector vector_;
    llvm::Value* element_;  ///< The vector's first element, made opaque.

private:
    std::map<FieldSlot, llvm::Value*> loads_;
};

/// Builds the loops around the body of a kernel.
class KernelLoops {
public:
    /// Writes the computations for a vector of each of the rows that are computed together. Leaves
    /// `builder` in a block without a terminator.
    using WriteVectors =
        llvm::function_ref<void(llvm::ArrayRef<CellVector> vectors, Builder& builder)>;
    /// Writes the code after the last vector of a row. `builder` as above.
    using WriteRowEnd = llvm::function_ref<void(llvm::Value* row_start, Builder& builder)>;

    explicit KernelLoops(KernelFrame& frame);

    /// A loop over the rows from `first` on, `together` of them at a time while enough are left. It
    /// begins where `builder` writes, which continues after it. Returns the row after the last
    /// computed one.
    llvm::Value* rows(Builder& builder, llvm::Value* first, int together,
                      WriteVectors write_vectors, WriteRowEnd write_row_end = nullptr);
    /// Writes all values of a vector of cells, and the stores of its results.
    void body(CellSources& cells, Builder& builder, const CellVector& vector);

private:
    /// The values common to all cells of a call, or of a row.
    class OuterSources final : public Sources {
    public:
        OuterSources(KernelFrame& frame, Builder& builder, llvm::Value* row)
            : frame_(frame), builder_(builder), row_(row) {}

        llvm::Value* uniform(UniformSlot slot) override { return frame_.uniform(slot); }
        llvm::Value* hidden(std::uint64_t word) override { return frame_.hidden(word); }
        llvm::Value* cell_row() override;
        llvm::Value* cell_slice() override;

    private:
        llvm::Value* word(llvm::Value* count);

        KernelFrame& frame_;
        Builder& builder_;
        llvm::Value* row_;  ///< Null before the loops.
    };

    /// Returns the element number of the first cell of each row.
    std::vector<llvm::Value*> columns(llvm::Value* row, int together, Builder& outside,
                                      llvm::BasicBlock* next, WriteVectors write_vectors);

    KernelFrame& frame_;
    Body body_;
    CellSchedule schedule_;
    OuterSources sources_;
    BodyScope scope_;
};

/// Adds a function to `module`, whose data layout is already the target's. It has the common
/// arguments, arguments of the types `extra`, and the code that `write_loops` writes, which ends
/// with a return.
llvm::Function* build_function(
    llvm::Module& module, const KernelPart& part, const KernelShape& shape, const std::string& name,
    llvm::ArrayRef<llvm::Type*> extra,
    llvm::function_ref<void(KernelFrame& frame, KernelLoops& loops, Builder& builder)> write_loops);

}  // namespace cascade
