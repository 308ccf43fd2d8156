// Makes the meshes of surfaces for pages, in a thread of its own: a large model takes seconds.
#pragma once

#include "run/pictures/shown_surface.h"
#include "view/outbox.h"

#include <cstdint>
#include <functional>
#include <memory>

namespace cascade {

class SurfaceSender {
public:
    /// `send` gets a page and its frame; null if memory is short.
    using Send = std::function<void(std::uint64_t page, SharedBytes frame)>;

    explicit SurfaceSender(Send send);
    /// Waits for the mesh that is being made.
    ~SurfaceSender();
    SurfaceSender(const SurfaceSender&) = delete;
    SurfaceSender& operator=(const SurfaceSender&) = delete;

    /// Sends a surface, whose number is that of its snapshots. The last one is kept for other
    /// pages.
    void ask(std::uint64_t page, std::shared_ptr<const SurfaceSource> surface,
             std::uint64_t number);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace cascade
