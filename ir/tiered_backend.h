// Kernels that are interpreted at once and switch to native code when it is ready.
//
// Loading a code generator takes longer than a small run. So begin() returns an interpreted kernel.
// Meanwhile a thread of the backend compiles the kernel, and later calls of the kernel run native
// code. Interpreted and native code give the same bits, so results do not depend on the moment of
// the switch. Once a kernel has been interpreted for about as long as its compilation takes, calls
// wait for its native code, because further interpretation would only slow the compiler down.
#pragma once

#include "ir/backend.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace cascade {

/// Interpreting this number of cells takes about as long as compiling their kernel. Both times grow
/// with the number of operations. With twenty operations, interpreting a cell takes 4 ns and
/// compiling takes about 10 ms.
inline constexpr std::int64_t cells_worth_compiling = 262144;

/// Wraps another backend. compile() returns the kernels of the wrapped backend. Thread-safe.
/// Kernels may outlive this TieredBackend. A kernel that is not compiled when the TieredBackend is
/// destroyed stays interpreted.
class TieredBackend final : public Backend {
public:
    explicit TieredBackend(std::unique_ptr<Backend> native);
    /// Compiles the kernels that still wait and have been used often enough to be worth compiling,
    /// so that later processes find the compiled code on disk.
    ~TieredBackend() override;
    TieredBackend(const TieredBackend&) = delete;
    TieredBackend& operator=(const TieredBackend&) = delete;

    std::string_view name() const override;
    Result<KernelPointer> compile(const CellKernel& kernel, Stencil stencil) override;
    KernelPointer find(const CellKernel& kernel, Stencil stencil) override;
    /// The backend for kernels that run too rarely to be worth compiling. Thread-safe.
    Backend& interpreter() const { return *interpreter_; }
    KernelCounts counts() const override;
    std::string code_identity() const override;

    /// When to compile a kernel. Until then it is interpreted.
    enum class When : std::uint8_t {
        now,  ///< At once, because the kernel will run for long.
        /// Once the kernel has interpreted `cells_worth_compiling` cells. A cell with links counts
        /// as more than one cell.
        when_used,
    };
    /// Returns a kernel that can run at once: the result of find(), or else an interpreted kernel
    /// that switches to native code once it is compiled (Kernel::is_provisional). If compilation
    /// fails, the kernel stays interpreted (Kernel::refusal). After the kernel has interpreted
    /// `cells_worth_compiling` cells, calls of the kernel wait until it is compiled. Kernels are
    /// compiled in the order in which begin() was called for them.
    KernelPointer begin(const CellKernel& kernel, Stencil stencil, When when);
    /// Announces a kernel that will be passed to begin() or compile() later. An announced kernel is
    /// compiled after all kernels passed to begin().
    void expect(const CellKernel& kernel, Stencil stencil);
    /// Waits until every kernel that has already been used often enough to be compiled is compiled
    /// or has failed to compile.
    void settle();
    /// Drops the kernels that wait for compilation, which then stay interpreted. Waits until the
    /// kernel that is being compiled is finished, because compilation cannot be interrupted.
    void abandon();

private:
    class Worker;
    std::unique_ptr<Backend> native_;
    std::unique_ptr<Backend> interpreter_;
    std::shared_ptr<Worker> worker_;
};

}  // namespace cascade
