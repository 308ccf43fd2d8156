// Kernels that run at once and become native code when that is made.
//
// Loading a code generator takes longer than a small run. So begin() hands out a kernel that is
// interpreted; a thread of the backend's own compiles it, and from then on its calls run native
// code. Both give the same bits, so nobody sees from the results when that was. A kernel that has
// been interpreted for about as long as code takes to be made waits for it: interpreting further
// would only slow the compiler down.
#pragma once

#include "ir/backend.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace cascade {

/// So many cells are interpreted in about the time in which code for them is made: both grow with
/// the number of operations, 4 ns a cell for twenty of them against some ten milliseconds.
inline constexpr std::int64_t cells_worth_compiling = 262144;

/// A backend around another, whose kernels are those of compile(). All may be called from several
/// threads. Kernels outlive it, as what they are when it ends.
class TieredBackend final : public Backend {
public:
    explicit TieredBackend(std::unique_ptr<Backend> native);
    /// Compiles kernels that have been used enough and still wait, so that another process will
    /// find them on disk.
    ~TieredBackend() override;
    TieredBackend(const TieredBackend&) = delete;
    TieredBackend& operator=(const TieredBackend&) = delete;

    std::string_view name() const override;
    Result<KernelPointer> compile(const CellKernel& kernel, Stencil stencil) override;
    KernelPointer find(const CellKernel& kernel, Stencil stencil) override;
    KernelCounts counts() const override;
    std::string code_identity() const override;

    /// When code is made for a kernel that is interpreted meanwhile.
    enum class When : std::uint8_t {
        now,        ///< It is known to run for long.
        when_used,  ///< Once it has run over `cells_worth_compiling` cells.
    };
    /// A kernel that can run now: that of find(), or one that is interpreted until it is compiled
    /// (Kernel::is_provisional), for good where that fails (Kernel::refusal). Calls wait for code
    /// that is wanted once they have interpreted `cells_worth_compiling` cells meanwhile. Kernels
    /// are compiled in the order in which they were begun.
    KernelPointer begin(const CellKernel& kernel, Stencil stencil, When when);
    /// The kernel will be begun, or compiled, later: it is compiled when nothing else is to be.
    void expect(const CellKernel& kernel, Stencil stencil);
    /// Waits until there is code for all kernels that have been used enough by now, or none can be
    /// made.
    void settle();
    /// Forgets the kernels that wait: those that were begun stay interpreted. Only the one being
    /// compiled, which nothing can interrupt, is finished.
    void abandon();

private:
    class Worker;
    std::unique_ptr<Backend> native_;
    std::unique_ptr<Backend> interpreter_;
    std::shared_ptr<Worker> worker_;
};

}  // namespace cascade
