// The parts that the functions of all kernels share: their arguments, the loops over rows and over
// the vectors of a row, loads of the cells' own values, and stores. Code that reads other cells is
// in skeleton_grid.cpp and skeleton_linked.cpp.
//
// Internal to jit/*.cpp. The first arguments of all functions, with double for float in kernels of
// binary64:
//
//     const float *const *fields, const unsigned char *const *masks,
//     const float *uniforms, float *const *results,
//     int64_t column_begin, int64_t column_end, int64_t stride, int64_t row_begin, int64_t row_end
//
// Pointers are to cell (0, 0, 0) of planes in the layout of PlaneLayout. Rows are numbered by their
// position in memory. The function computes columns [column_begin, column_end) of rows [row_begin,
// row_end), in vectors of `lanes` cells. `column_begin` is a multiple of PlaneLayout::row_pad. The
// last vector of a row may extend beyond `column_end`, at most to the next such multiple.
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

constexpr int cache_line = 64;  ///< In bytes.

/// The values shared by all rows and vectors: the arguments and the addresses of planes.
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
    /// An argument that follows the common arguments; `number` counts from 0.
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

    // Addresses of planes. Each is loaded once.
    llvm::Value* field_plane(FieldSlot slot) { return plane(0, slot.index()); }
    llvm::Value* mask_plane(MaskSlot slot) { return plane(1, slot.index()); }
    llvm::Value* result_plane(std::size_t slot) { return plane(3, part_.results[slot]); }

    llvm::Type* vector_of(llvm::Type* element) const {
        return llvm::FixedVectorType::get(element, static_cast<unsigned>(lanes()));
    }
    llvm::Value* splat(Builder& builder, llvm::Value* element) const {
        return builder.CreateVectorSplat(static_cast<unsigned>(lanes()), element);
    }

    /// If the field is read at neighbours, tells LLVM that no result overlaps it.
    template <typename Load>
    Load* mark(Load* load, FieldSlot slot) const {
        return kernel().reads_neighbours(slot) ? aliases_.mark(load, 0) : load;
    }

    llvm::Value* uniform(UniformSlot slot);
    /// A constant loaded from a variable of the module, so that LLVM cannot fold it.
    llvm::Value* hidden(std::uint64_t word);

    /// Prefetches a cache line. The address may be invalid, because a prefetch never faults.
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

/// The vector of cells that one execution of the innermost loop computes. All planes have the same
/// layout, so the same element number serves all of them. An access adds this number to a plane's
/// address, which costs nothing, because the processor has an addressing mode for it.
struct CellVector {
    llvm::Value* row = nullptr;         ///< The number of the row.
    llvm::Value* row_start = nullptr;   ///< The element number of the row's first cell.
    llvm::Value* first = nullptr;       ///< The element number of the first computed cell.
    llvm::Value* element = nullptr;     ///< The element number of the vector's first cell.
    CarriedVectors* carried = nullptr;  ///< Values passed from this vector to the next.
    BodyScope* row_scope = nullptr;     ///< Values that all cells of the row share.
};

/// Loads the values of a vector's own cells, and stores their results.
class CellSources : public Sources {
public:
    CellSources(KernelFrame& frame, Builder& builder, const CellVector& vector)
        : frame_(frame), builder_(builder), vector_(vector), element_(opaque(vector.element)) {}

    llvm::Value* field(FieldSlot slot) override;
    llvm::Value* mask(MaskSlot slot) override;
    llvm::Value* cell_column() override;
    void store(std::size_t result, llvm::Value* number);
    /// Writes a loop over the links of the cells. Defines the results of its reductions in the
    /// scope `cells`.
    virtual void reduce_links(BodyScope& cells, const LinkLoop& loop);

protected:
    // Hides from LLVM's strength reduction how an element number was computed. Otherwise LLVM would
    // replace "base plus number" by one pointer for each plane and row, run out of registers, and
    // load the pointers from the stack again and again (1.2 to 1.5 times slower with five species).
    llvm::Value* opaque(llvm::Value* element) { return builder_.CreateFreeze(element); }

    KernelFrame& frame_;
    Builder& builder_;
    CellVector vector_;
    /// The element number of the vector's first cell, hidden from LLVM by opaque().
    llvm::Value* element_;

private:
    std::map<FieldSlot, llvm::Value*> loads_;
};

/// Builds the loops around the body of a kernel.
class KernelLoops {
public:
    /// Writes the computation of one vector in each of the rows that are computed together. Must
    /// leave `builder` in a block without a terminator.
    using WriteVectors =
        llvm::function_ref<void(llvm::ArrayRef<CellVector> vectors, Builder& builder)>;
    /// Writes the code after the last vector of a row. Must also leave `builder` in a block without
    /// a terminator.
    using WriteRowEnd = llvm::function_ref<void(llvm::Value* row_start, Builder& builder)>;

    explicit KernelLoops(KernelFrame& frame);

    /// Writes a loop over the rows from `first` on, which computes `together` rows at a time as
    /// long as enough are left. The loop begins where `builder` writes, and `builder` continues
    /// after it. Returns the first row that is not computed.
    llvm::Value* rows(Builder& builder, llvm::Value* first, int together,
                      WriteVectors write_vectors, WriteRowEnd write_row_end = nullptr);
    /// Writes the code of all values of a vector of cells, and the stores of their results.
    void body(CellSources& cells, Builder& builder, const CellVector& vector);

private:
    /// The sources that all cells of a call, or of a row, share.
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

    /// Writes the loop over the vectors of some rows. Returns the element number of the first cell
    /// of each row.
    std::vector<llvm::Value*> columns(llvm::Value* row, int together, Builder& outside,
                                      llvm::BasicBlock* next, WriteVectors write_vectors);

    KernelFrame& frame_;
    Body body_;
    CellSchedule schedule_;
    OuterSources sources_;
    BodyScope scope_;
};

/// Adds a function to `module`, which must have the target's data layout already. The function has
/// the common arguments, and arguments of the types `extra`. Its code is what `write_loops` writes,
/// followed by a return.
llvm::Function* build_function(
    llvm::Module& module, const KernelPart& part, const KernelShape& shape, const std::string& name,
    llvm::ArrayRef<llvm::Type*> extra,
    llvm::function_ref<void(KernelFrame& frame, KernelLoops& loops, Builder& builder)> write_loops);

}  // namespace cascade
