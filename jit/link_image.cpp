// A client of JITLink, which gives JITLink memory, symbols of other objects, and the list of
// symbols to link.
#include "jit/link_image.h"

#include <fmt/format.h>
#include <llvm/ExecutionEngine/JITLink/JITLink.h>
#include <llvm/Support/MemoryBufferRef.h>

#include <algorithm>
#include <memory>

namespace cascade {
namespace {

namespace jitlink = llvm::jitlink;

llvm::Error error_of(const llvm::Twine& text) {
    return llvm::createStringError(llvm::inconvertibleErrorCode(), text);
}

Failure as_failure(llvm::Error error) {
    return {"native code could not be linked: " + llvm::toString(std::move(error)), ""};
}

/// Links one object to an image at the address `base`.
class ImageLink final : public jitlink::JITLinkContext, public jitlink::JITLinkMemoryManager {
public:
    /// At the end of the link, `result` is set and this object is deleted.
    ImageLink(llvm::StringRef name, std::uint64_t base, Result<CodeImage>& result)
        : JITLinkContext(nullptr), name_(name), base_(base), result_(result) {}

    jitlink::JITLinkMemoryManager& getMemoryManager() override { return *this; }

    /// Leaves out the usual passes for a target. They would add tables of absolute addresses, which
    /// an image must not contain, and tables for unwinding the stack, which kernels do not need,
    /// because they never throw.
    bool shouldAddDefaultTargetPasses(const llvm::Triple&) const override { return false; }

    llvm::Error modifyPassConfig(jitlink::LinkGraph&, jitlink::PassConfiguration& passes) override {
        passes.PrePrunePasses.push_back(
            [this](jitlink::LinkGraph& graph) { return find_function(graph); });
        return llvm::Error::success();
    }

    /// Puts all segments into the image, one after another. No two segments share a cache line.
    void allocate(const jitlink::JITLinkDylib*, jitlink::LinkGraph& graph,
                  OnAllocatedFunction done) override {
        jitlink::BasicLayout layout(graph);
        std::uint64_t size = 0;
        for (auto& [kind, segment] : layout.segments()) {
            if (segment.Alignment.value() > CodeImage::alignment) {
                return done(error_of("it must be aligned to more than a page"));
            }
            size = llvm::alignTo(size, std::max(segment.Alignment, llvm::Align(64)));
            segment.Addr = llvm::orc::ExecutorAddr(base_ + size);
            size += segment.ContentSize + segment.ZeroFillSize;
        }
        image_.bytes.resize(size);
        for (auto& [kind, segment] : layout.segments()) {
            segment.WorkingMem = image_.bytes.data() + (segment.Addr.getValue() - base_);
        }
        if (auto error = layout.apply()) return done(std::move(error));
        done(std::make_unique<InImage>());
    }
    void deallocate(std::vector<FinalizedAlloc>, OnDeallocatedFunction done) override {
        done(llvm::Error::success());
    }

    void lookup(const LookupMap& symbols,
                std::unique_ptr<jitlink::JITLinkAsyncLookupContinuation> done) override {
        done->run(error_of("it refers to " + symbols.begin()->first));
    }

    llvm::Error notifyResolved(jitlink::LinkGraph&) override {
        image_.entry = function_->getAddress().getValue() - base_;
        return llvm::Error::success();
    }
    void notifyFinalized(FinalizedAlloc) override { result_ = std::move(image_); }
    void notifyFailed(llvm::Error error) override {
        result_ = tl::unexpected(as_failure(std::move(error)));
    }

private:
    /// Memory that is a part of the image and is freed with it.
    class InImage final : public InFlightAlloc {
        void abandon(OnAbandonedFunction done) override { done(llvm::Error::success()); }
        void finalize(OnFinalizedFunction done) override { done(FinalizedAlloc()); }
    };

    /// Marks the function as used, so that only the function and the code that it uses, directly or
    /// indirectly, are linked.
    llvm::Error find_function(jitlink::LinkGraph& graph) {
        for (jitlink::Symbol* symbol : graph.defined_symbols()) {
            if (symbol->hasName() && symbol->getName() == name_) function_ = symbol;
        }
        if (!function_) return error_of("there is no function " + name_);
        function_->setLive(true);
        return llvm::Error::success();
    }

    llvm::StringRef name_;
    std::uint64_t base_;
    Result<CodeImage>& result_;
    CodeImage image_;
    jitlink::Symbol* function_ = nullptr;
};

Result<CodeImage> link_at(std::uint64_t base, std::string_view object, std::string_view name) {
    auto graph = jitlink::createLinkGraphFromObject({object, "kernel"});
    if (!graph) return tl::unexpected(as_failure(graph.takeError()));
    Result<CodeImage> result = failure("native code could not be linked");
    jitlink::link(std::move(*graph), std::make_unique<ImageLink>(name, base, result));
    return result;
}

}  // namespace

Result<CodeImage> link_image(std::string_view object, std::string_view name) {
    // The object is linked at two addresses. If both images have the same bytes, the bytes do not
    // depend on the address. The two addresses differ in each of their 16-bit parts, because an
    // instruction may contain 16 bits of an address.
    constexpr std::uint64_t base = 0, other_base = 0x7a5b'3c5d'8e6f'9000;
    auto image = link_at(base, object, name);
    if (!image) return image;
    const auto other = link_at(other_base, object, name);
    if (!other) return other;
    if (image->bytes != other->bytes) {
        return failure("native code could not be linked: it depends on where it lies");
    }
    return image;
}

}  // namespace cascade
