// Stores texts in a queue, and frames in one slot for each kind.
#include "view/outbox.h"

#include <algorithm>

namespace cascade {

Outbox::Added Outbox::wake() {
    return std::exchange(is_awake_, true) ? Added::awake : Added::sleeping;
}

Outbox::Added Outbox::add_text(std::string text) {
    const std::lock_guard lock(mutex_);
    if (text.size() > most_text_ - text_bytes_) return Added::overflow;
    text_bytes_ += text.size();
    texts_.push_back(std::make_shared<const std::string>(std::move(text)));
    return wake();
}

Outbox::Added Outbox::add_frame(int kind, SharedBytes bytes) {
    const std::lock_guard lock(mutex_);
    const auto same_kind = [kind](const auto& frame) { return frame.first == kind; };
    const auto waiting = std::find_if(frames_.begin(), frames_.end(), same_kind);
    if (waiting != frames_.end()) {
        waiting->second = std::move(bytes);
    } else {
        frames_.emplace_back(kind, std::move(bytes));
    }
    return wake();
}

std::optional<Outgoing> Outbox::next() {
    const std::lock_guard lock(mutex_);
    if (!texts_.empty()) {
        Outgoing text = {std::move(texts_.front()), true};
        texts_.pop_front();
        text_bytes_ -= text.bytes->size();
        return text;
    }
    if (!frames_.empty()) {
        Outgoing frame = {std::move(frames_.front().second), false};
        frames_.erase(frames_.begin());
        return frame;
    }
    is_awake_ = false;
    return std::nullopt;
}

}  // namespace cascade
