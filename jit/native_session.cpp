// The ORC session: one library of symbols, a resource tracker for each function.
//
// Object files are made by jit/code.cpp; only ORC's linking layer is used here. Nothing of the
// process is visible to the code that is loaded, so a call of a library function, which would break
// the promise of equal bits, shows as a failure to link.
#include "jit/native_session.h"

#include <fmt/format.h>
#include <llvm/ExecutionEngine/Orc/Core.h>
#include <llvm/ExecutionEngine/Orc/ExecutorProcessControl.h>
#include <llvm/ExecutionEngine/Orc/ObjectLinkingLayer.h>
#include <llvm/Support/MemoryBuffer.h>

namespace cascade {
namespace {

Failure as_failure(llvm::Error error) {
    return {"native code could not be loaded: " + llvm::toString(std::move(error)), ""};
}

class OrcSession final : public NativeSession, public std::enable_shared_from_this<OrcSession> {
public:
    explicit OrcSession(std::unique_ptr<llvm::orc::ExecutorProcessControl> control)
        : session_(std::move(control)), layer_(session_) {
        // The same errors come back as values; without a reporter they are also printed.
        session_.setErrorReporter([](llvm::Error error) { llvm::consumeError(std::move(error)); });
        library_ = &session_.createBareJITDylib("kernels");
    }

    ~OrcSession() override { llvm::consumeError(session_.endSession()); }

    Result<std::unique_ptr<LoadedFunction>> load(std::span<const char> object,
                                                 const std::string& name) override;

private:
    llvm::orc::ExecutionSession session_;
    llvm::orc::ObjectLinkingLayer layer_;
    llvm::orc::JITDylib* library_ = nullptr;
};

class OrcFunction final : public LoadedFunction {
public:
    OrcFunction(std::shared_ptr<OrcSession> session, llvm::orc::ResourceTrackerSP tracker)
        : session_(std::move(session)), tracker_(std::move(tracker)) {}

    ~OrcFunction() override { llvm::consumeError(tracker_->remove()); }

    const llvm::orc::ResourceTrackerSP& tracker() const { return tracker_; }

    OrcFunction(const OrcFunction&) = delete;
    OrcFunction& operator=(const OrcFunction&) = delete;

private:
    std::shared_ptr<OrcSession> session_;  // Outlives the tracker: members go in reverse order.
    llvm::orc::ResourceTrackerSP tracker_;
};

Result<std::unique_ptr<LoadedFunction>> OrcSession::load(std::span<const char> object,
                                                         const std::string& name) {
    auto buffer =
        llvm::MemoryBuffer::getMemBufferCopy(llvm::StringRef(object.data(), object.size()), name);
    auto function =
        std::make_unique<OrcFunction>(shared_from_this(), library_->createResourceTracker());
    if (auto error = layer_.add(function->tracker(), std::move(buffer))) {
        return tl::unexpected(as_failure(std::move(error)));
    }
    auto symbol = session_.lookup({library_}, name);
    if (!symbol) return tl::unexpected(as_failure(symbol.takeError()));
    function->address = static_cast<std::uintptr_t>(symbol->getAddress().getValue());
    return function;
}

}  // namespace

Result<std::shared_ptr<NativeSession>> NativeSession::make() {
    auto control = llvm::orc::SelfExecutorProcessControl::Create();
    if (!control) return tl::unexpected(as_failure(control.takeError()));
    return std::make_shared<OrcSession>(std::move(*control));
}

}  // namespace cascade
