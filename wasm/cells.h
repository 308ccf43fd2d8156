// Code that loads the sources of a kernel, which are its operations without operands, and code that
// stores its results.
//
// Internal to wasm/. A loop computes a group of vectors of cells in each pass. Addresses of rows
// are computed once per group, and loaded values belong to one vector.
#pragma once

#include "core/grid.h"
#include "ir/cell_kernel.h"
#include "wasm/arithmetic.h"
#include "wasm/function.h"

#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace cascade::wasm {

/// The parameters of a kernel's function, in order. wasm/kernel_module.h explains them.
enum class Parameter : std::uint32_t {
    fields,
    masks,
    uniforms,
    results,
    column_begin,
    column_end,
    stride,
    row_begin,
    row_end,
    shared_parameters,
    // Further parameters for grids of one slice.
    left_column = shared_parameters,
    right_column,
    plane_parameters,
    // Further parameters for grids of several slices.
    slice_rows = shared_parameters,
    slice,
    volume_parameters,
    // Further parameters for linked cells.
    starts = shared_parameters,
    bases,
    offsets,
    weights,
    gradient_x,
    gradient_y,
    gradient_z,
    filled,
    linked_parameters,
};
constexpr Local local_of(Parameter parameter) {
    return Local(static_cast<std::uint32_t>(parameter));
}

/// The cells that the loops have reached, as distances in bytes from cell (0, 0, 0) of a plane of
/// numbers.
struct Place {
    Local row;    ///< The first cell of the row.
    Local group;  ///< The first cell of the group.
};

class Cells {
public:
    Cells(Function& function, const CellKernel& kernel, Stencil stencil, Place place, bool is_exact)
        : function_(function),
          kernel_(kernel),
          stencil_(stencil),
          place_(place),
          is_exact_(is_exact) {}
    virtual ~Cells() = default;

    /// Begins a group of this number of vectors. Writes the code of the group's Laplacians and sums
    /// over links, which are computed before all other values.
    virtual void begin_group(int vectors) = 0;
    /// Selects a vector of the group by its index. The following calls refer to it.
    void begin_vector(int number) { vector_ = number; }
    void end_vector();

    // Return a local that has the value of the source in each lane, valid until the end of the
    // vector. For a mask, a lane's bits are all set or all clear.
    Local uniform(UniformSlot slot);
    Local cell_row();
    Local cell_slice();
    Local cell_column();
    Local mask(MaskSlot slot);
    Local field(FieldSlot slot) { return load({slot}); }
    Local neighbour(Neighbour at);
    virtual Local laplacian(FieldSlot slot) = 0;
    /// The local of any sum over links except `laplacian`.
    virtual Local link_sum(const Instruction& sum) = 0;

    // A loop over the links of the vector. The code written at link level between these two calls
    // is its body.
    virtual void begin_links();
    virtual void end_links();
    // Return a local with the following values, one for each lane, valid until the end of the body.
    /// The value of a field in the cell to which each lane's link leads.
    virtual Local theirs(FieldSlot slot);
    /// All bits of a lane are set if the lane has a link, and clear otherwise.
    virtual Local is_link();

    void store(std::size_t result, Local number);
    /// Copies columns to the halo of a row of a result, if the arguments name columns. `row_end` is
    /// the end of the row's last column.
    void fill_columns(Code& code, std::size_t result, Local row_end);

protected:
    /// A field, and the distance in columns, rows and slices to the cell in which the field is
    /// read.
    struct Reading {
        FieldSlot slot;
        int dx = 0, dy = 0, dz = 0;
        friend auto operator<=>(const Reading&, const Reading&) = default;
    };

    Code& code() { return function_.at(LoopLevel::cell); }
    Arithmetic arithmetic() { return {function_, LoopLevel::cell, is_exact_}; }

    Local load(const Reading& reading);
    /// Does the same as load(), but flushes the value in exact kernels, for use as an operand of
    /// arithmetic.
    Local operand(const Reading& reading);
    /// The address of the plane with this slot in `table`, minus pad_bytes().
    Local plane(Parameter table, std::size_t slot);
    /// Addresses of planes are reduced by this many bytes. The offsets of instructions are
    /// unsigned, and with the smaller address they also reach cells to the west.
    std::uint32_t pad_bytes() const {
        return static_cast<std::uint32_t>(PlaneLayout::row_pad * function_.number_bytes());
    }
    /// Moves the top of the stack to a local that is valid until the end of the vector.
    Local keep();
    /// Pushes the number of columns from the row's first cell to the vector's first cell.
    void push_column();
    /// Replaces the top of the stack, a word, by a vector with this word in all lanes.
    void splat_word(Code& code);

    Function& function_;
    const CellKernel& kernel_;
    Stencil stencil_;
    Place place_;
    bool is_exact_;
    int vector_ = 0;  ///< The index of the vector in its group.

private:
    struct RowOfPlane {
        Parameter table;
        std::size_t slot;
        int dy = 0, dz = 0;
        friend auto operator<=>(const RowOfPlane&, const RowOfPlane&) = default;
    };

    std::uint32_t offset_of_vector() const {
        return static_cast<std::uint32_t>(vector_ * Code::vector_bytes);
    }
    Local address(const RowOfPlane& row);
    Local row_offset(int dy, int dz);

    std::map<std::pair<Parameter, std::size_t>, Local> planes_;
    std::map<std::pair<int, int>, Local> row_offsets_;
    std::map<RowOfPlane, Local> addresses_;  ///< The addresses that serve the whole group.
    std::map<Reading, Local> loads_, operands_;
    std::vector<Local> kept_;  ///< The locals to release at the end of the vector.
};

std::unique_ptr<Cells> make_grid_cells(Function& function, const CellKernel& kernel,
                                       Stencil stencil, Place place, bool is_exact);
std::unique_ptr<Cells> make_linked_cells(Function& function, const CellKernel& kernel, Place place,
                                         bool is_exact);

}  // namespace cascade::wasm
