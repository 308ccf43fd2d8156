// What waits to be sent to one page: every text in order, and the newest frame of each kind.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cascade {

/// Bytes that are sent, shared by the pages that receive them.
using SharedBytes = std::shared_ptr<const std::string>;

/// A message on its way out.
struct Outgoing {
    SharedBytes bytes;
    bool is_text = false;
};

/// Filled by any thread, emptied by one. A slow reader costs no more than one frame of each kind
/// and a bounded amount of text.
class Outbox {
public:
    explicit Outbox(std::size_t most_text) : most_text_(most_text) {}

    enum class Added {
        sleeping,  ///< The sender is to be woken.
        awake,     ///< The sender will come by.
        overflow,  ///< More text waits than is allowed; nothing was added.
    };

    Added add_text(std::string text);
    /// Replaces a frame of the same kind that waits.
    Added add_frame(int kind, SharedBytes bytes);

    /// The next message: texts first, then the kind of frame that has waited longest. Nothing if
    /// the outbox is empty; then the sender sleeps until it is woken.
    std::optional<Outgoing> next();

private:
    Added wake();

    std::mutex mutex_;
    const std::size_t most_text_;
    std::size_t text_bytes_ = 0;
    std::deque<SharedBytes> texts_;
    std::vector<std::pair<int, SharedBytes>> frames_;
    bool is_awake_ = false;
};

}  // namespace cascade
