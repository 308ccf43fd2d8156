// The contract between kernels and their executors.
//
// Backends: ir/interpreter.h (blocks of cells; the reference), jit/jit.h (native code by LLVM),
// ir/tiered_backend.h (the first until the second is ready). All give the same bits for the same
// kernel and arguments.
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

/// The columns of cells that halo columns −1 and `width` copy.
struct HaloColumns {
    std::int64_t left = 0, right = 0;
    friend bool operator==(const HaloColumns&, const HaloColumns&) = default;
};

/// The inputs and outputs of a kernel. Pointers are to cell (0, 0, 0) of planes of one layout. A
/// field read by `laplacian` or `neighbour` has its halo filled. An output may be a field from
/// which no other output is computed (sole_results()). Otherwise it must not overlap other planes.
/// A kernel that computes the last cell of a row may write any values into the output row after it,
/// up to the next multiple of PlaneLayout::row_pad (so halo column `width` is undefined
/// afterwards), but never to other cells that it is not told to compute.
template <typename Number>
struct KernelArgumentsOf {
    std::span<const Number* const> fields;       ///< One per field slot.
    std::span<const std::uint8_t* const> masks;  ///< One per mask slot.
    std::span<const Number> uniforms;            ///< One per uniform slot.
    std::span<Number* const> results;            ///< One per result.
    PlaneLayout layout;
    LinkTable<Number> links = {};  ///< For grids of linked cells.
    /// All fields are in a cache near the core, so prefetching the next rows would only evict them.
    bool is_near = false;
    /// The columns that kernels copy to columns −1 and `width` of rows that they compute as a
    /// whole. If nullopt, they fill none.
    std::optional<HaloColumns> columns = {};
};
using KernelArguments = KernelArgumentsOf<float>;

/// An executable kernel. Its results never change. It may run on several threads at once, each on
/// its own cells and inside a FlushDenormals.
class Kernel {
public:
    virtual ~Kernel() = default;
    /// Computes the cells of a patch in the kernel's precision. Its columns begin at multiples of
    /// PlaneLayout::row_pad, and end there or at the end of the rows. Linked cells are computed in
    /// whole rows.
    virtual void run(const KernelArgumentsOf<float>&, const Patch&) const { wrong_precision(); }
    virtual void run(const KernelArgumentsOf<double>&, const Patch&) const { wrong_precision(); }

    /// Whether the kernel fills columns of the halo if told which. Once true, always true.
    virtual bool fills_columns() const { return false; }
    /// Whether the kernel may become many times faster later, because its code is still being
    /// compiled. Its present speed then does not predict later runs.
    virtual bool is_provisional() const { return false; }
    /// Why the kernel stays slow; null if it does not.
    virtual const Failure* refusal() const { return nullptr; }

private:
    [[noreturn]] static void wrong_precision() {
        CHECK(false, "a kernel is given numbers of its own precision");
    }
};

using KernelPointer = std::shared_ptr<const Kernel>;

/// The number of kernels by origin of their code.
struct KernelCounts {
    std::int64_t compiled = 0;  ///< Compiled by this backend.
    std::int64_t found = 0;     ///< Compiled by an earlier process and found on disk.
};

/// Makes kernels executable. Stores compiled kernels, so that an equal one costs only a lookup.
class Backend {
public:
    virtual ~Backend() = default;
    virtual std::string_view name() const = 0;  ///< "interp" or "jit".
    /// `stencil` must be the stencil of every grid that the kernel will run on.
    virtual Result<KernelPointer> compile(const CellKernel& kernel, Stencil stencil) = 0;
    /// The result of compile(), if obtaining it takes less time than running it once; else null.
    virtual KernelPointer find(const CellKernel& kernel, Stencil stencil) = 0;
    /// The counts so far.
    virtual KernelCounts counts() const { return {}; }
    /// Other facts that determine the code of a kernel, such as the processor; empty if unknown.
    virtual std::string code_identity() const { return {}; }
};

}  // namespace cascade
