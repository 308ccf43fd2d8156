// A server for the browser of this machine's user. It serves the files of a page and its
// WebSockets.
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

/// Files by their path. "/" is the page itself.
using PageFiles = std::map<std::string, PageFile, std::less<>>;

/// Identifies an open page, which has one WebSocket. A number is never used again for another page.
using PageId = std::uint64_t;

/// Callbacks that the server's thread calls one at a time. They must not throw, and should return
/// soon, because the server waits for them. They may send messages, and may stop the server.
struct PageHandlers {
    std::function<void(PageId)> opened = [](PageId) {};
    std::function<void(PageId, std::string_view text)> message = [](PageId, std::string_view) {};
    /// Called once for each page that has been opened.
    std::function<void(PageId)> closed = [](PageId) {};
};

/// Limits on the resources that connections and pages may use.
struct ServerLimits {
    std::size_t header_bytes = 8192;                   ///< For the headers of a request.
    std::size_t message_bytes = std::size_t{1} << 20;  ///< For each text from a page.
    /// The largest number of bytes of text that may wait to be sent to one page.
    std::size_t waiting_text = std::size_t{16} << 20;
    std::size_t connections = 64;
    std::size_t pages = 8;
    /// A connection is closed if no complete request arrives within this time. Browsers open spare
    /// connections, which would otherwise stay open.
    std::chrono::milliseconds request_time{10000};
    /// A page is closed if it sends nothing for this time, not even an answer to a ping.
    std::chrono::milliseconds idle_time{60000};
};

/// Listens only at the loopback addresses, at a free port, in a separate thread. Answers GET and
/// HEAD with its files. No HTTP request changes anything. Pages send commands through the WebSocket
/// `/session?token=…`, which view/admission.h protects.
class LocalServer {
public:
    /// Fails if no port can be opened or if the thread cannot be started.
    static Result<LocalServer> start(PageFiles files, PageHandlers handlers,
                                     const ServerLimits& limits = {});
    LocalServer(LocalServer&&) noexcept;
    LocalServer& operator=(LocalServer&&) noexcept;
    /// Stops the server. Handlers must not destroy it.
    ~LocalServer();

    std::uint16_t port() const;
    const std::string& token() const;
    /// The address to open in a browser. It contains the token after '#', a part that browsers
    /// never send to a server.
    std::string address() const;

    /// Sends a text. Texts arrive in the order of the calls. A page that leaves too many texts
    /// unread is closed. Sending to a closed page has no effect. Any thread may call this function.
    void send_text(PageId page, std::string text);
    /// Sends bytes. They are dropped if newer bytes of the same kind arrive before the page has
    /// received them.
    void send_frame(PageId page, int kind, SharedBytes bytes);

    /// Closes all pages and ends the server's thread, within half a second. Any thread may call
    /// this function. Once stop() has returned, no handler is called any more. If a handler calls
    /// stop(), the thread ends only after the handler has returned.
    void stop();

private:
    struct State;
    explicit LocalServer(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace cascade
