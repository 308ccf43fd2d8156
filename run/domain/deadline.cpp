// A thread waits until the time is over or the work has ended, whichever comes first.
#include "run/domain/deadline.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace cascade {

struct Deadline::Clock {
    std::atomic<bool>& cancel;
    std::mutex mutex;
    std::condition_variable is_over;
    bool is_stopped = false;
    bool has_cancelled = false;
    std::thread thread;

    Clock(double seconds, std::atomic<bool>& of) : cancel(of) {
        thread = std::thread([this, seconds] {
            std::unique_lock lock(mutex);
            const auto time = std::chrono::duration<double>(seconds);
            if (is_over.wait_for(lock, time, [this] { return is_stopped; })) return;
            has_cancelled = true;
            cancel = true;
        });
    }

    void stop() {
        {
            const std::lock_guard lock(mutex);
            is_stopped = true;
        }
        is_over.notify_all();
        if (thread.joinable()) thread.join();
    }
};

Deadline::Deadline(double seconds, std::atomic<bool>& cancel) {
    if (seconds > 0) clock_ = std::make_unique<Clock>(seconds, cancel);
}

Deadline::~Deadline() {
    if (clock_) clock_->stop();
}

bool Deadline::ends_work() {
    if (!clock_) return false;
    clock_->stop();
    if (!clock_->has_cancelled) return false;
    clock_->cancel = false;
    return true;
}

}  // namespace cascade
