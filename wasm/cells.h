// The sources that a kernel's operations without operands read, and the stores of its results.
//
// Internal to wasm/. A group of vectors of cells is computed together. Then the loop continues with
// the next group. Addresses of rows belong to the group, loaded values to the vector.
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

/// The parameters of a kernel's function, in order: see wasm/kernel_module.h.
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
    // For grids of one slice.
    left_column = shared_parameters,
    right_column,
    plane_parameters,
    // For grids of several slices.
    slice_rows = shared_parameters,
    slice,
    volume_parameters,
    // For linked cells.
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

/// The position of the loops: bytes from cell (0, 0, 0) of a plane of numbers.
struct Place {
    Local row;    ///< The row's first cell.
    Local group;  ///< The group's first cell.
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

    /// Begins a group of this number of vectors. Emits its Laplacians and sums over links, which
    /// are computed before all other values.
    virtual void begin_group(int vectors) = 0;
    /// Selects a vector of the group, by its number, for the calls that follow.
    void begin_vector(int number) { vector_ = number; }
    void end_vector();

    // The local that has the source's value in all lanes, until the end of the vector. A mask sets
    // or clears all bits of a lane.
    Local uniform(UniformSlot slot);
    Local cell_row();
    Local cell_slice();
    Local cell_column();
    Local mask(MaskSlot slot);
    Local field(FieldSlot slot) { return load({slot}); }
    Local neighbour(Neighbour at);
    virtual Local laplacian(FieldSlot slot) = 0;
    /// All but `laplacian`.
    virtual Local link_sum(const Instruction& sum) = 0;

    // A loop over the links of the vector. Its body is the code of links written between these
    // calls.
    virtual void begin_links();
    virtual void end_links();
    // The local that has this for all lanes, until the end of the body.
    /// A field's values in the linked cells.
    virtual Local theirs(FieldSlot slot);
    /// The bits of a lane are set if it has a link, else clear.
    virtual Local is_link();

    void store(std::size_t result, Local number);
    /// Fills the columns of the halo beside a row of a result, whose last column ends at `row_end`.
    void fill_columns(Code& code, std::size_t result, Local row_end);

protected:
    /// A field, and the numbers of columns, rows and slices from the cell to where it is read.
    struct Reading {
        FieldSlot slot;
        int dx = 0, dy = 0, dz = 0;
        friend auto operator<=>(const Reading&, const Reading&) = default;
    };

    Code& code() { return function_.at(LoopLevel::cell); }
    Arithmetic arithmetic() { return {function_, LoopLevel::cell, is_exact_}; }

    Local load(const Reading& reading);
    /// The same as an operand of arithmetic.
    Local operand(const Reading& reading);
    /// A plane's address in a table, for numbers pad_bytes() before its first cell.
    Local plane(Parameter table, std::size_t slot);
    /// Addresses of planes are this many bytes before the first cell, so that reads west of a cell
    /// have no negative offset.
    std::uint32_t pad_bytes() const {
        return static_cast<std::uint32_t>(PlaneLayout::row_pad * function_.number_bytes());
    }
    /// The top of the stack, stored until the end of the vector.
    Local keep();
    /// Pushes the number of columns from the row's first cell to the vector's.
    void push_column();
    /// The top of the stack, a word, spread to all lanes.
    void splat_word(Code& code);

    Function& function_;
    const CellKernel& kernel_;
    Stencil stencil_;
    Place place_;
    bool is_exact_;
    int vector_ = 0;  ///< Its number in the group.

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
    std::map<RowOfPlane, Local> addresses_;  ///< Addresses for the group.
    std::map<Reading, Local> loads_, operands_;
    std::vector<Local> kept_;  ///< Locals of the vector.
};

std::unique_ptr<Cells> make_grid_cells(Function& function, const CellKernel& kernel,
                                       Stencil stencil, Place place, bool is_exact);
std::unique_ptr<Cells> make_linked_cells(Function& function, const CellKernel& kernel, Place place,
                                         bool is_exact);

}  // namespace cascade::wasm
