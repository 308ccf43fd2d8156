// Carries out requests of pages, and sends them snapshots from a separate thread.
#include "view/page_server.h"

#include "run/pictures/shown_surface.h"
#include "run/session/session.h"
#include "run/session/session_model.h"
#include "view/loaded_models.h"
#include "view/outbox.h"
#include "view/page_answer.h"
#include "view/page_message.h"
#include "view/page_reply.h"
#include "view/page_requests.h"

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <thread>
#include <utility>

namespace cascade {

namespace {

// Makes surface meshes for pages in a separate thread, because a large model takes seconds.

class SurfaceSender {
public:
    /// Called with a page and its frame. The frame is null if memory was exhausted.
    using Send = std::function<void(std::uint64_t page, SharedBytes frame)>;

    explicit SurfaceSender(Send send);
    /// Waits for the mesh that is being made.
    ~SurfaceSender();
    SurfaceSender(const SurfaceSender&) = delete;
    SurfaceSender& operator=(const SurfaceSender&) = delete;

    /// Makes a surface in the other thread and sends it to a page. `number` identifies the surface
    /// in snapshots. The last frame is stored, because other pages may need it.
    void ask(std::uint64_t page, std::shared_ptr<const SurfaceSource> surface,
             std::uint64_t number);

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Uses only one thread. The others remain free for the steps of the session.
SharedBytes frame_of(const SurfaceSource& surface, std::uint64_t number) {
    try {
        Team team(1);
        return std::make_shared<const std::string>(
            print_surface(shown_surface(surface, team), number));
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}

struct SurfaceSender::State {
    struct Wish {
        std::uint64_t page = 0;
        std::shared_ptr<const SurfaceSource> surface;
        std::uint64_t number = 0;
    };

    Send send;
    std::mutex mutex;  ///< Protects the waiting requests.
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

/// A page requests its next snapshot after it has drawn the last one. So a slow page receives fewer
/// snapshots.
struct OpenPage {
    bool wants_snapshot = false;
    std::uint64_t seen = 0;  ///< The number of the last snapshot that was sent.
};

/// The largest number of seconds for making a model's cells. It is limited, because models that are
/// loaded on a page may come from strangers.
constexpr double most_model_seconds = 120;
constexpr int snapshot_frame = 0, surface_frame = 1, file_frame = 2;

}  // namespace

struct PageServer::State {
    std::mutex mutex;  ///< Protects all members below that have no locks of their own.
    std::condition_variable is_wanted;
    std::map<PageId, OpenPage> pages;
    PageRequests requests;
    bool is_ending = false;
    bool offers_library = false;
    std::uint64_t told_script = 0;  ///< Only the sending thread uses this member.
    // The session is destroyed before the server, which receives its answers.
    std::optional<LocalServer> server;
    std::unique_ptr<Session> session;
    std::optional<SurfaceSender> surfaces;
    std::optional<LoadedModels> models;  ///< Only the session's thread uses this member.
    std::filesystem::path saved_in;      ///< The folder in which files to save are made.
    std::thread sender;

    ~State();
    Result<void> start(PageFiles files);
    void greet(PageId page);
    void obey(PageId page, std::string_view text);
    void tell_script(std::vector<PageId> to);
    std::vector<PageId> open_pages();
    void send_snapshots();
};

Result<void> PageServer::State::start(PageFiles files) {
    PageHandlers handlers;
    handlers.opened = [this](PageId page) { greet(page); };
    handlers.message = [this](PageId page, std::string_view text) { obey(page, text); };
    handlers.closed = [this](PageId page) {
        requests.close(page);
        const std::lock_guard lock(mutex);
        pages.erase(page);
    };
    const std::lock_guard lock(mutex);
    auto started = LocalServer::start(std::move(files), std::move(handlers));
    if (!started) return tl::unexpected(started.error());
    server.emplace(std::move(*started));
    surfaces.emplace([this](PageId page, SharedBytes frame) {
        if (frame) return server->send_frame(page, surface_frame, std::move(frame));
        server->send_text(page,
                          print_failure(0, {"there is not enough memory to show the surface", ""}));
    });
    session->watch([this](const Progress& progress) {
        for (const PageId page : open_pages()) server->send_text(page, print_progress(progress));
    });
    sender = std::thread([this] { send_snapshots(); });
    return {};
}

PageServer::State::~State() {
    {
        const std::lock_guard lock(mutex);
        is_ending = true;
    }
    is_wanted.notify_all();
    if (sender.joinable()) sender.join();
    if (server) server->stop();
    surfaces.reset();
    session.reset();
}

void PageServer::State::greet(PageId page) {
    {
        const std::lock_guard lock(mutex);
        pages[page] = {};
        server->send_text(page, print_palettes());
        if (offers_library) server->send_text(page, print_systems());
    }
    tell_script({page});
}

void PageServer::State::tell_script(std::vector<PageId> to) {
    session->ask([this, to = std::move(to)](LiveRun& run) {
        const std::string text = print_script(run);
        for (const PageId page : to) server->send_text(page, text);
    });
}

std::vector<PageId> PageServer::State::open_pages() {
    const std::lock_guard lock(mutex);
    std::vector<PageId> open;
    for (const auto& page : pages) open.push_back(page.first);
    return open;
}

void PageServer::State::obey(PageId page, std::string_view text) {
    auto message = parse_page_message(text);
    if (!message) return server->send_text(page, print_failure(0, message.error()));
    const std::uint64_t id = message->id;
    if (std::holds_alternative<NextSnapshot>(message->request)) {
        {
            const std::lock_guard lock(mutex);
            pages[page].wants_snapshot = true;
        }
        return is_wanted.notify_all();
    }
    if (const auto* named = std::get_if<NamePage>(&message->request)) {
        return requests.name(page, named->name);
    }
    if (const auto* question = std::get_if<PageQuestion>(&message->request)) {
        return session->ask([this, page, id, asked = *question](LiveRun& run) {
            server->send_text(page, print_reply(id, asked, run));
        });
    }
    if (auto* part = std::get_if<LoadPart>(&message->request)) {
        return session->ask([this, page, id, loaded = std::move(*part)](LiveRun&) {
            server->send_text(page, print_loaded(id, models->add(loaded)));
        });
    }
    if (auto* asked = std::get_if<SaveModel>(&message->request)) {
        return session->ask([this, page, id, save = std::move(*asked)](LiveRun& run) {
            auto saved = session_model(run, save.request, save.form, saved_in);
            if (!saved) {
                auto why = tl::unexpected(std::move(saved.error()));
                return server->send_text(page, print_answer(id, std::move(why), ""));
            }
            server->send_frame(page, file_frame,
                               std::make_shared<const std::string>(print_saved(id, *saved)));
        });
    }
    if (std::holds_alternative<AskForSurface>(message->request)) {
        const auto snapshot = session->newest();
        if (snapshot->surface) surfaces->ask(page, snapshot->surface, snapshot->surface_number);
        return;
    }
    PageRequests::Begun begun = requests.begin(page, id);
    if (begun.answer) return server->send_text(page, std::move(*begun.answer));
    if (!begun.is_new) return;
    auto command = std::get<SessionCommand>(std::move(message->request));
    std::string script = text_of(command);
    if (std::holds_alternative<Pause>(command)) session->cancel();
    session->post(std::move(command), [this, from = std::move(begun.page), id,
                                       script = std::move(script)](const Accepted<void>& result) {
        const std::string answer = print_answer(id, result, script);
        server->send_text(requests.finish(*from, id, answer), answer);
    });
}

void PageServer::State::send_snapshots() {
    std::unique_lock lock(mutex);
    while (true) {
        const auto wants = [](const auto& page) { return page.second.wants_snapshot; };
        is_wanted.wait(lock,
                       [&] { return is_ending || std::any_of(pages.begin(), pages.end(), wants); });
        if (is_ending) return;
        std::uint64_t seen = UINT64_MAX;
        for (const auto& [page, state] : pages) {
            if (state.wants_snapshot) seen = std::min(seen, state.seen);
        }
        lock.unlock();
        const auto snapshot = session->newer_than(seen, std::chrono::milliseconds(100));
        const SharedBytes frame =
            snapshot ? std::make_shared<const std::string>(print_snapshot(*snapshot)) : nullptr;
        lock.lock();
        if (!snapshot) continue;
        if (const auto version = version_of_script(*snapshot); version != told_script) {
            told_script = version;
            std::vector<PageId> all;
            for (const auto& page : pages) all.push_back(page.first);
            tell_script(std::move(all));
        }
        for (auto& [page, state] : pages) {
            if (!state.wants_snapshot || state.seen >= snapshot->number) continue;
            state = {false, snapshot->number};
            server->send_frame(page, snapshot_frame, frame);
        }
    }
}

PageServer::PageServer(std::unique_ptr<State> state) : state_(std::move(state)) {}
PageServer::~PageServer() = default;

Result<std::unique_ptr<PageServer>> PageServer::start(std::unique_ptr<LiveRun> run, PageFiles files,
                                                      bool offers_library,
                                                      std::filesystem::path models) {
    auto state = std::make_unique<State>();
    state->saved_in = models;
    state->models.emplace(std::move(models), run->script().folder);
    run->limit_models(most_model_seconds);
    state->session = std::make_unique<Session>(std::move(run));
    state->offers_library = offers_library;
    if (auto started = state->start(std::move(files)); !started) {
        return tl::unexpected(started.error());
    }
    return std::unique_ptr<PageServer>(new PageServer(std::move(state)));
}

std::uint16_t PageServer::port() const { return state_->server->port(); }
std::string PageServer::address() const { return state_->server->address(); }

}  // namespace cascade
