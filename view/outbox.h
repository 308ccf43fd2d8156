// The messages that wait to be sent to one page: all texts in order, and the newest frame of each
// kind.
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

/// A message to be sent.
struct Outgoing {
    SharedBytes bytes;
    bool is_text = false;
};

/// Any thread may add messages, and a single thread sends them. If the page reads slowly, at most
/// one frame of each kind and a limited amount of text wait.
class Outbox {
public:
    explicit Outbox(std::size_t most_text) : most_text_(most_text) {}

    enum class Added {
        sleeping,  ///< The sender sleeps and must be woken.
        awake,     ///< The sender is awake and will find the message.
        overflow,  ///< Too much text is waiting, so this message was dropped.
    };

    Added add_text(std::string text);
    /// Replaces a waiting frame of the same kind.
    Added add_frame(int kind, SharedBytes bytes);

    /// Removes and returns the next message: texts first, then the frame that has waited longest.
    /// Empty if there is no message. The sender then counts as sleeping until somebody wakes it.
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
