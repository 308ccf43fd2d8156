// The contract between kernels and what executes them.
//
// Backends: ir/interpreter.h (blocks of cells; the oracle), jit/jit.h (native code by LLVM),
// ir/tiered_backend.h (the first until the second is ready). All give the same bits for the same
// kernel and arguments.
#pragma once

#include "core/check.h"
#include "core/grid.h"
#include "core/links.h"
#include "core/parallel.h"
#include "core/result.h"
#include "ir/cell_kernel.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace cascade {

/// Where a kernel finds and puts its values. Pointers are to cell (0, 0, 0) of planes of one
/// layout; a field read by `laplacian` or `neighbour` has its halo filled. An output overlaps
/// nothing else, but it may be a field of which the kernel reads the own cell only. A kernel may
/// write any values into an output row beyond its last cell, up to the next multiple of
/// PlaneLayout::row_pad (so halo column `width` may hold garbage afterwards); cells of other rows
/// and columns < 0 never.
template <typename Number>
struct KernelArgumentsOf {
    std::span<const Number* const> fields;       ///< One per field slot.
    std::span<const std::uint8_t* const> masks;  ///< One per mask slot.
    std::span<const Number> uniforms;            ///< One per uniform slot.
    std::span<Number* const> results;            ///< One per result.
    PlaneLayout layout;
    LinkTable<Number> links = {};  ///< Of cells that lie on no grid.
    /// All fields are in a near cache: fetching what the next rows read would only take their
    /// place.
    bool is_near = false;
};
using KernelArguments = KernelArgumentsOf<float>;

/// A kernel ready to run. Its results never change; safe to run on several threads at once, each on
/// its own rows, inside a FlushDenormals.
class Kernel {
public:
    virtual ~Kernel() = default;
    /// Computes rows, numbered through all slices, with numbers of the kernel's precision.
    virtual void run(const KernelArgumentsOf<float>&, RowRange) const { wrong_precision(); }
    virtual void run(const KernelArgumentsOf<double>&, RowRange) const { wrong_precision(); }

    /// May it be many times as fast some time later, because code for it is still to be made? How
    /// long it takes now then says nothing of later runs.
    virtual bool is_provisional() const { return false; }
    /// Why it will stay as slow as it is; nothing where it is as it should be.
    virtual const Failure* refusal() const { return nullptr; }

private:
    [[noreturn]] static void wrong_precision() {
        CHECK(false, "a kernel is given numbers of its own precision");
    }
};

using KernelPointer = std::shared_ptr<const Kernel>;

/// Where the code of kernels came from.
struct KernelCounts {
    std::int64_t compiled = 0;  ///< Made by this backend.
    std::int64_t found = 0;     ///< Made by an earlier process and kept on disk.
};

/// Makes kernels runnable. Keeps what it made: compiling an equal kernel again costs a look-up.
class Backend {
public:
    virtual ~Backend() = default;
    virtual std::string_view name() const = 0;  ///< "interp" or "jit".
    /// `stencil` is that of every grid that the kernel will run on.
    virtual Result<KernelPointer> compile(const CellKernel& kernel, Stencil stencil) = 0;
    /// What compile() gives, if that takes less time than running it once; else null.
    virtual KernelPointer find(const CellKernel& kernel, Stencil stencil) = 0;
    /// So far.
    virtual KernelCounts counts() const { return {}; }
    /// All that decides the code of kernels besides themselves, such as the processor, as bytes;
    /// empty where it is not known.
    virtual std::string code_identity() const { return {}; }
};

}  // namespace cascade
