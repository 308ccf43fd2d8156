// The messages that wait for one page: every text in order, and the newest frame of each kind.
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

/// Bytes to send, shared by the pages that receive them.
using SharedBytes = std::shared_ptr<const std::string>;

/// A message on its way out.
struct Outgoing {
    SharedBytes bytes;
    bool is_text = false;
};

/// Any thread fills it, and one empties it. A slow reader costs at most one frame of each kind and
/// a bounded amount of text.
class Outbox {
public:
    explicit Outbox(std::size_t most_text) : most_text_(most_text) {}

    enum class Added {
        sleeping,  ///< The sender must be woken.
        awake,     ///< The sender will check the outbox.
        overflow,  ///< Too much text waits. This one was dropped.
    };

    Added add_text(std::string text);
    /// Replaces a waiting frame of the same kind.
    Added add_frame(int kind, SharedBytes bytes);

    /// The next message: texts first, then the kind of frame that has waited longest. nullopt if
    /// the outbox is empty. Then the sender sleeps until it is woken.
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
