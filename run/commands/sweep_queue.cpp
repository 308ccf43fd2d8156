// A message begins with a letter that says its kind. Messages that hand out a run continue with its
// number. Results continue with the number of the run and the packed result.
#include "run/commands/sweep_queue.h"

#include "core/check.h"

#include <charconv>
#include <chrono>
#include <string_view>
#include <thread>
#include <utility>

namespace cascade {
namespace {

// The letters of messages from other ranks to rank 0.
constexpr char asks = 'a', gives = 'g', leaves = 'l';
// The letters of messages from rank 0 to other ranks.
constexpr char run_follows = 'r', no_more = 'n', cancelled = 'c', released = 'e';

constexpr auto between_looks = std::chrono::milliseconds(1);

std::string_view words_of(const Messenger::Letter& letter) {
    return {reinterpret_cast<const char*>(letter.bytes.data()), letter.bytes.size()};
}

/// Reads the number at the beginning of a text, and removes it together with the blank after it.
std::size_t take_number(std::string_view& text) {
    std::size_t number = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
    CHECK(read.ec == std::errc(), "a message of a sweep contains the number of a run");
    text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
    if (text.starts_with(' ')) text.remove_prefix(1);
    return number;
}

}  // namespace

SweepQueue::SweepQueue(std::vector<std::size_t> waiting, Messenger* messenger)
    : messenger_(messenger) {
    if (!is_root()) return;
    waiting_.assign(waiting.begin(), waiting.end());
    for (int rank = 1; messenger_ != nullptr && rank < messenger_->count(); ++rank) {
        busy_.insert(rank);
    }
}

std::optional<std::size_t> SweepQueue::next(bool serves) {
    std::unique_lock lock(mutex_);
    if (!is_root()) {
        ++asked_;
        while (waiting_.empty() && !is_over_) {
            if (!serves) {
                changed_.wait(lock);
                continue;
            }
            lock.unlock();
            (void)serve();
            std::this_thread::sleep_for(between_looks);
            lock.lock();
        }
    }
    if (waiting_.empty() || is_cancelled_) return std::nullopt;
    const std::size_t run = waiting_.front();
    waiting_.pop_front();
    return run;
}

void SweepQueue::give(std::size_t run, const SweepResult& result) {
    std::string text = gives + std::to_string(run) + " " + pack_result(result);
    const std::lock_guard lock(mutex_);
    results_.push_back(std::move(text));
}

void SweepQueue::cancel() {
    const std::lock_guard lock(mutex_);
    is_over_ = is_cancelled_ = true;
    changed_.notify_all();
}

bool SweepQueue::is_cancelled() const {
    const std::lock_guard lock(mutex_);
    return is_cancelled_;
}

std::vector<SweepQueue::Taken> SweepQueue::serve() {
    std::vector<Taken> taken;
    if (messenger_ == nullptr) return taken;
    const std::lock_guard lock(mutex_);
    for (; !results_.empty(); results_.pop_front()) post(0, results_.front());
    for (; asked_ > 0; --asked_) post(0, {asks});
    if (is_root() && is_cancelled_ && !has_told_) {
        for (const int rank : busy_) post(rank, {cancelled});
        has_told_ = true;
    }
    while (const auto letter = messenger_->receive()) {
        if (is_root()) {
            answer(*letter, taken);
        } else {
            obey(*letter);
        }
    }
    return taken;
}

/// On rank 0: answers a message.
void SweepQueue::answer(const Messenger::Letter& letter, std::vector<Taken>& taken) {
    std::string_view text = words_of(letter);
    const char kind = text.front();
    text.remove_prefix(1);
    if (kind == gives) {
        const std::size_t run = take_number(text);
        auto result = unpack_result(text);
        CHECK(result, "a rank of the same build sends a complete result");
        taken.push_back({run, *std::move(result)});
    } else if (kind == leaves) {
        busy_.erase(letter.from);
        post(letter.from, {released});
    } else if (waiting_.empty() || is_cancelled_) {
        post(letter.from, {no_more});
    } else {
        post(letter.from, run_follows + std::to_string(waiting_.front()));
        waiting_.pop_front();
    }
}

/// On other ranks: obeys a message of rank 0.
void SweepQueue::obey(const Messenger::Letter& letter) {
    std::string_view text = words_of(letter);
    const char kind = text.front();
    text.remove_prefix(1);
    if (kind == run_follows) waiting_.push_back(take_number(text));
    if (kind == no_more || kind == cancelled) is_over_ = true;
    if (kind == cancelled) is_cancelled_ = true;
    if (kind == released) is_released_ = true;
    changed_.notify_all();
}

bool SweepQueue::has_finished() {
    if (messenger_ == nullptr) return true;
    const std::lock_guard lock(mutex_);
    if (is_root()) return busy_.empty();
    if (!has_told_ && results_.empty()) {
        post(0, {leaves});
        has_told_ = true;
    }
    return is_released_;
}

void SweepQueue::post(int rank, const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    messenger_->post(rank, {bytes.begin(), bytes.end()});
}

}  // namespace cascade
