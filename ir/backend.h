// The interface between kernels and the code that runs them.
//
// Backends: ir/interpreter.h (the reference, which works on blocks of cells), jit/jit.h (native
// code by LLVM), ir/tiered_backend.h (interprets until native code is ready). All three give the
// same bits for the same kernel and arguments.
#pragma once

#include "core/check.h"
#include "core/grid.h"
#include "core/links.h"
#include "core/patch.h"
#include "core/result.h"
#include "ir/cell_kernel.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace cascade {

/// The columns that a kernel copies to the halo: column `left` to halo column −1, and column
/// `right` to halo column `width`.
struct HaloColumns {
    std::int64_t left = 0, right = 0;
    friend bool operator==(const HaloColumns&, const HaloColumns&) = default;
};

/// The inputs and outputs of a kernel. Each pointer points to cell (0, 0, 0) of a plane, and all
/// planes have the same layout. The halo of a field that the kernel reads by `laplacian` or
/// `neighbour` must be filled before the call. An output may be the plane of a field if no other
/// output is computed from that field (sole_results()). Apart from this, outputs must not overlap
/// other planes. After the last cell of a row, a kernel may also write any values up to the next
/// multiple of PlaneLayout::row_pad, so halo column `width` is undefined afterwards. The kernel
/// writes to no other cells than these and the cells that it is asked to compute.
template <typename Number>
struct KernelArgumentsOf {
    std::span<const Number* const> fields;       ///< A plane for each field slot.
    std::span<const std::uint8_t* const> masks;  ///< A plane for each mask slot.
    std::span<const Number> uniforms;            ///< A number for each uniform slot.
    std::span<Number* const> results;            ///< A plane for each result.
    PlaneLayout layout;
    LinkTable<Number> links = {};  ///< The links of linked cells.
    /// Whether all fields are in a cache near the core, so that prefetching the next rows would
    /// only evict them.
    bool is_near = false;
    /// The columns to copy to halo columns −1 and `width`. Kernels copy them in each row that they
    /// compute as a whole. If nullopt, kernels copy none.
    std::optional<HaloColumns> columns = {};
};
using KernelArguments = KernelArgumentsOf<float>;

/// An executable kernel. The results depend only on the arguments. Several threads may run a kernel
/// at once, each on different cells and inside a FlushDenormals.
class Kernel {
public:
    virtual ~Kernel() = default;
    /// Computes the cells of a patch. The numbers must have the kernel's precision. The patch's
    /// columns begin at multiples of PlaneLayout::row_pad, and end at a multiple of it or at the
    /// end of the rows. Linked cells are computed in whole rows.
    virtual void run(const KernelArgumentsOf<float>&, const Patch&) const { wrong_precision(); }
    virtual void run(const KernelArgumentsOf<double>&, const Patch&) const { wrong_precision(); }

    /// Whether run() copies the columns named by KernelArguments::columns to the halo. A kernel
    /// that has once returned true always returns true.
    virtual bool fills_columns() const { return false; }
    /// Whether the kernel's code is still being compiled. The kernel may then become many times
    /// faster, so its present speed does not predict later runs.
    virtual bool is_provisional() const { return false; }
    /// The reason why the kernel could not be compiled and stays slow. Null if the kernel was
    /// compiled or still waits for compilation.
    virtual const Failure* refusal() const { return nullptr; }

private:
    [[noreturn]] static void wrong_precision() {
        CHECK(false, "a kernel is given numbers of its own precision");
    }
};

using KernelPointer = std::shared_ptr<const Kernel>;

/// How many kernels with native code this process has obtained.
struct KernelCounts {
    std::int64_t compiled = 0;  ///< Compiled by this backend.
    std::int64_t found = 0;     ///< Compiled by an earlier process and found on disk.
};

/// Makes kernels executable. A backend keeps every kernel that it has compiled, so compiling an
/// equal kernel again is only a lookup.
class Backend {
public:
    virtual ~Backend() = default;
    virtual std::string_view name() const = 0;  ///< "interp" or "jit".
    /// Compiles a kernel for grids with this stencil. The kernel must not run on other grids.
    virtual Result<KernelPointer> compile(const CellKernel& kernel, Stencil stencil) = 0;
    /// Returns the result of compile() if obtaining it takes less time than interpreting the kernel
    /// once. Otherwise returns null.
    virtual KernelPointer find(const CellKernel& kernel, Stencil stencil) = 0;
    /// The number of kernels compiled and found so far.
    virtual KernelCounts counts() const { return {}; }
    /// A text that identifies everything on which the code of all kernels depends, such as the
    /// processor. Empty if unknown.
    virtual std::string code_identity() const { return {}; }
};

}  // namespace cascade
