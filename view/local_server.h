// A server for the browser of this machine's user: the files of a page, and its WebSockets.
#pragma once

#include "core/result.h"
#include "view/outbox.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace cascade {

/// A file of the page, held in memory. `type` is its MIME type.
struct PageFile {
    std::string type;
    std::string content;
};

/// The files by path. "/" is the page itself.
using PageFiles = std::map<std::string, PageFile, std::less<>>;

/// An open page: one WebSocket. Numbers are never reused.
using PageId = std::uint64_t;

/// Called by the server's thread, one at a time. They must not throw, and should return soon,
/// because the server waits for them. They may send, and may stop the server.
struct PageHandlers {
    std::function<void(PageId)> opened = [](PageId) {};
    std::function<void(PageId, std::string_view text)> message = [](PageId, std::string_view) {};
    std::function<void(PageId)> closed = [](PageId) {};  ///< Once for each page that was opened.
};

/// Limits on the resources of strangers and pages.
struct ServerLimits {
    std::size_t header_bytes = 8192;                   ///< Per request.
    std::size_t message_bytes = std::size_t{1} << 20;  ///< Per text from a page.
    std::size_t waiting_text = std::size_t{16} << 20;  ///< Bytes of texts that wait for one page.
    std::size_t connections = 64;
    std::size_t pages = 8;
    /// Closes a connection without a whole request by then, because browsers open spare ones.
    std::chrono::milliseconds request_time{10000};
    /// Closes a page that has been silent for this time, also when asked for a sign of life.
    std::chrono::milliseconds idle_time{60000};
};

/// Listens at a free port of the loopback addresses only, in a thread of its own. It answers GET
/// and HEAD, serves only its files, and requests change no state. Pages send commands through the
/// WebSocket `/session?token=…` (see view/admission.h for who may open it).
class LocalServer {
public:
    /// Fails if no port can be opened or no thread started.
    static Result<LocalServer> start(PageFiles files, PageHandlers handlers,
                                     const ServerLimits& limits = {});
    LocalServer(LocalServer&&) noexcept;
    LocalServer& operator=(LocalServer&&) noexcept;
    /// Stops. Handlers must not call it.
    ~LocalServer();

    std::uint16_t port() const;
    const std::string& token() const;
    /// The address to open. It carries the token after '#', which browsers never send.
    std::string address() const;

    /// Sends a text after earlier ones. A page that leaves too many unread is closed. Sending to a
    /// closed page has no effect. Any thread may send.
    void send_text(PageId page, std::string text);
    /// Sends bytes, unless newer ones of the same kind arrive before the page has taken these.
    void send_frame(PageId page, int kind, SharedBytes bytes);

    /// Closes all pages and ends the thread, within half a second. Any thread may call it, also a
    /// handler, for which the thread ends later. After it has returned to another thread, no
    /// handler is called.
    void stop();

private:
    struct State;
    explicit LocalServer(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace cascade
