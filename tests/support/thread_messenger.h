// Ranks as threads of one process, so that tests of ranks need no MPI.
#pragma once

#include "ranks/messenger.h"

#include <algorithm>
#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace cascade::test {

/// The messages on their way, by sender and receiver.
class Mail {
public:
    void put(int from, int to, std::span<const std::byte> bytes) {
        const std::lock_guard lock(mutex_);
        waiting_[{from, to}].emplace_back(bytes.begin(), bytes.end());
        has_come_.notify_all();
    }
    /// Waits for the next message. Returns whether it has the expected length.
    bool take(int from, int to, std::span<std::byte> bytes) {
        std::unique_lock lock(mutex_);
        std::deque<std::vector<std::byte>>& letters = waiting_[{from, to}];
        has_come_.wait(lock, [&] { return !letters.empty(); });
        const std::vector<std::byte> first = std::move(letters.front());
        letters.pop_front();
        if (first.size() != bytes.size()) return false;
        std::memcpy(bytes.data(), first.data(), first.size());
        return true;
    }

    void post(int from, int to, std::vector<std::byte> bytes) {
        const std::lock_guard lock(mutex_);
        posted_[to].push_back({from, std::move(bytes)});
    }
    std::optional<Messenger::Letter> receive(int to) {
        const std::lock_guard lock(mutex_);
        std::deque<Messenger::Letter>& letters = posted_[to];
        if (letters.empty()) return std::nullopt;
        Messenger::Letter first = std::move(letters.front());
        letters.pop_front();
        return first;
    }
    /// Whether every posted message has been received.
    bool is_empty() {
        const std::lock_guard lock(mutex_);
        return std::all_of(posted_.begin(), posted_.end(),
                           [](const auto& each) { return each.second.empty(); });
    }

private:
    std::mutex mutex_;
    std::condition_variable has_come_;
    std::map<int, std::deque<Messenger::Letter>> posted_;  ///< Posted letters by receiver.
    std::map<std::pair<int, int>, std::deque<std::vector<std::byte>>> waiting_;
};

class ThreadMessenger final : public Messenger {
public:
    ThreadMessenger(Mail& mail, int rank, int count) : mail_(mail), rank_(rank), count_(count) {}

    int rank() const override { return rank_; }
    int count() const override { return count_; }
    void exchange(std::span<const Message> out, std::span<const Message> in) override {
        for (const Message& each : out) mail_.put(rank_, each.rank, each.bytes);
        for (const Message& each : in) {
            if (!mail_.take(each.rank, rank_, each.bytes)) abort(1);
        }
    }
    void complete(std::span<const std::span<std::byte>> blocks) override {
        std::vector<Message> out, in;
        for (int other = 0; other < count_; ++other) {
            if (other == rank_) continue;
            out.push_back({other, blocks[static_cast<std::size_t>(rank_)]});
            in.push_back({other, blocks[static_cast<std::size_t>(other)]});
        }
        exchange(out, in);
    }
    void broadcast(std::span<std::byte> bytes) override {
        std::vector<Message> out, in;
        for (int other = 1; rank_ == 0 && other < count_; ++other) out.push_back({other, bytes});
        if (rank_ > 0) in.push_back({0, bytes});
        exchange(out, in);
    }
    void post(int rank, std::vector<std::byte> bytes) override {
        mail_.post(rank_, rank, std::move(bytes));
    }
    std::optional<Letter> receive() override { return mail_.receive(rank_); }
    void finish() override {}
    [[noreturn]] void abort(int) override { std::abort(); }

private:
    Mail& mail_;
    int rank_, count_;
};

/// Calls `work` on `count` ranks at the same time.
inline void on_ranks(int count, const std::function<void(Messenger& messenger)>& work) {
    Mail mail;
    std::vector<std::thread> threads;
    for (int rank = 0; rank < count; ++rank) {
        threads.emplace_back([&, rank] {
            ThreadMessenger messenger(mail, rank, count);
            work(messenger);
        });
    }
    for (std::thread& each : threads) each.join();
    if (!mail.is_empty()) std::abort();  // A message that nobody has received.
}

}  // namespace cascade::test
