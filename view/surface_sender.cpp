// A queue of pages that wait, and one mesh at a time.
#include "view/surface_sender.h"

#include "view/page_answer.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <new>
#include <thread>
#include <utility>

namespace cascade {

namespace {

/// One thread, so that the steps of the session keep theirs.
SharedBytes frame_of(const SurfaceSource& surface, std::uint64_t number) {
    try {
        Team team(1);
        return std::make_shared<const std::string>(
            print_surface(shown_surface(surface, team), number));
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}

}  // namespace

struct SurfaceSender::State {
    struct Wish {
        std::uint64_t page = 0;
        std::shared_ptr<const SurfaceSource> surface;
        std::uint64_t number = 0;
    };

    Send send;
    std::mutex mutex;  ///< Of the wishes.
    std::condition_variable has_wish;
    std::deque<Wish> wishes;
    bool is_ending = false;
    std::thread thread;

    void work();
};

void SurfaceSender::State::work() {
    SharedBytes frame;
    std::uint64_t number = 0;
    std::unique_lock lock(mutex);
    while (true) {
        has_wish.wait(lock, [&] { return is_ending || !wishes.empty(); });
        if (is_ending) return;
        const Wish wish = std::move(wishes.front());
        wishes.pop_front();
        lock.unlock();
        if (number != wish.number || !frame) {
            frame = nullptr;
            frame = frame_of(*wish.surface, wish.number);
            number = wish.number;
        }
        send(wish.page, frame);
        lock.lock();
    }
}

SurfaceSender::SurfaceSender(Send send) : state_(std::make_unique<State>()) {
    state_->send = std::move(send);
    state_->thread = std::thread([state = state_.get()] { state->work(); });
}

SurfaceSender::~SurfaceSender() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->is_ending = true;
    }
    state_->has_wish.notify_all();
    state_->thread.join();
}

void SurfaceSender::ask(std::uint64_t page, std::shared_ptr<const SurfaceSource> surface,
                        std::uint64_t number) {
    {
        const std::lock_guard lock(state_->mutex);
        state_->wishes.push_back({page, std::move(surface), number});
    }
    state_->has_wish.notify_all();
}

}  // namespace cascade
