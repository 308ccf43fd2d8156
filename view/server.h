// The two classes of the server, built on Boost.Beast. Only their source files include this header,
// because the headers of Beast take long to compile.
//
// One thread handles all network events, so connections need no locks. Other threads only put
// messages into outboxes and tell that thread to check them.
#pragma once

#include "view/admission.h"
#include "view/local_server.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace cascade::serving {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using beast::error_code;

class Connection;

/// How long the server waits for pages to answer its close, and for clients to read a refusal.
constexpr std::chrono::milliseconds farewell_time{500};

/// The part of a connection to a page that threads other than the server's use. Only the server's
/// thread locks `connection`.
struct PageLine {
    std::shared_ptr<Outbox> outbox;
    std::weak_ptr<Connection> connection;
};

class Server {
public:
    Server(PageFiles page_files, PageHandlers page_handlers, const ServerLimits& server_limits)
        : files(std::move(page_files)), handlers(std::move(page_handlers)), limits(server_limits) {}
    ~Server();

    Result<void> start();
    void stop();
    /// Calls `add` with the page's outbox, so that `add` can put a message there. Then makes the
    /// server's thread send the message.
    template <typename Add>
    void send(PageId page, const Add& add);

    std::size_t count_pages();
    PageId add_page(PageLine line);
    void remove_page(PageId page);

    const PageFiles files;
    const PageHandlers handlers;
    const ServerLimits limits;
    std::uint16_t port = 0;
    std::string token;
    std::string policy;
    std::optional<Admission> admission;
    std::set<Connection*> connections;  ///< Only the server's thread uses this member.
    std::uint64_t last_connection = 0;  ///< Only the server's thread uses this member.

private:
    Result<void> open_doors();
    void accept(tcp::acceptor& door);
    void run();
    void close_all();
    bool make_room();

    std::mutex pages_mutex_;
    std::map<PageId, PageLine> pages_;
    PageId last_page_ = 0;
    std::mutex stop_mutex_;  ///< Held while waiting for the thread to end.
    bool is_closing_ = false;
    // Declared after `connections`, because destroying `io_` removes connections from it.
    asio::io_context io_{1};
    std::vector<tcp::acceptor> doors_;
    std::thread thread_;
};

/// A connection. Answers HTTP requests until a request opens the WebSocket of a page.
class Connection : public std::enable_shared_from_this<Connection> {
public:
    Connection(Server& server, tcp::socket socket)
        : number(++server.last_connection),
          server_(server),
          stream_(std::move(socket)),
          patience_(stream_.get_executor()) {
        server_.connections.insert(this);
    }
    ~Connection() { server_.connections.erase(this); }
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    void read_request();
    /// Sends the waiting messages, unless a message is being sent already.
    void send_waiting();
    void say_goodbye();
    /// Whether this connection may be closed to make room for another one. True of open connections
    /// that are not pages.
    bool is_stranger() const { return page_ == 0 && !is_closed_; }
    const std::uint64_t number;  ///< Counted in order of arrival.
    void close() {
        is_closed_ = true;
        patience_.cancel();
        stream_.next_layer().close();
    }

private:
    void answer_request();
    void refuse(const Rejection& refusal);
    void answer(unsigned status, std::string_view type, std::string_view content);
    void wait_for_end();
    void open_page();
    void read_text();
    void expect_end();

    Server& server_;
    websocket::stream<beast::tcp_stream> stream_;
    /// Limits how long the server waits for a page's answer to its close.
    asio::steady_timer patience_;
    beast::flat_buffer buffer_;
    std::optional<http::request_parser<http::empty_body>> parser_;
    http::response<http::span_body<const char>> response_;
    PageId page_ = 0;  ///< The number of the page. 0 if the connection is not a page.
    bool is_closed_ = false;
    std::shared_ptr<Outbox> outbox_;
    std::optional<Outgoing> sending_;
};

}  // namespace cascade::serving
