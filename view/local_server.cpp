// The server, built on Boost.Beast. No other file includes Beast, because its headers take long to
// compile.
//
// One thread handles all network events, so connections need no locks. Other threads only put
// messages into outboxes and tell that thread to check them.
#include "view/local_server.h"

#include "core/temporary_file.h"
#include "view/admission.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ip/v6_only.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include <array>
#include <csignal>
#include <fcntl.h>
#include <fmt/format.h>
#include <set>
#include <thread>

namespace cascade {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using beast::error_code;

namespace {

class Connection;

/// How long the server waits for pages to answer its close, and for clients to read a refusal.
constexpr std::chrono::milliseconds farewell_time{500};

/// The server whose thread this is. Null in all other threads.
thread_local const void* server_of_this_thread = nullptr;

/// Prevents programs that are started to show the page from inheriting the port.
template <typename Socket>
void close_on_exec(Socket& socket) {
    ::fcntl(socket.native_handle(), F_SETFD, FD_CLOEXEC);
}

/// The part of a connection to a page that other threads use. Only the server's thread locks
/// `connection`.
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
    /// Calls `add` with the page's outbox, so that it can put a message there. Then makes the
    /// server's thread send it.
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
    /// Whether this connection may be closed to make room for another. Pages and closed connections
    /// may not.
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

std::string_view view_of(beast::string_view text) { return {text.data(), text.size()}; }

std::optional<std::string_view> only_value(const http::fields& fields, http::field name) {
    if (fields.count(name) != 1) return std::nullopt;
    return view_of(fields[name]);
}

void Connection::read_request() {
    parser_.emplace();
    parser_->header_limit(static_cast<std::uint32_t>(server_.limits.header_bytes));
    stream_.next_layer().expires_after(server_.limits.request_time);
    const auto then = [self = shared_from_this()](error_code error, std::size_t) {
        if (!error) return self->answer_request();
        if (error == http::error::end_of_stream) return;
        if (error == http::error::header_limit) {
            return self->refuse({431, "The header of this request is too long."});
        }
        if (error.category() == make_error_code(http::error::end_of_stream).category()) {
            self->refuse({400, "This is no HTTP request."});
        }
    };
    http::async_read_header(stream_.next_layer(), buffer_, *parser_, then);
}

void Connection::answer_request() {
    const auto& request = parser_->get();
    const RequestHead head = {
        view_of(request.method_string()),       view_of(request.target()),
        only_value(request, http::field::host), only_value(request, http::field::origin),
        request.count(http::field::origin) > 0, websocket::is_upgrade(request)};
    if (const auto refusal = server_.admission->refuse(head)) return refuse(*refusal);
    if (parser_->chunked() || parser_->content_length().value_or(0) > 0) {
        return refuse({413, "This server takes no content."});
    }
    if (head.is_upgrade) return open_page();
    const auto file = server_.files.find(path_of(head.target));
    if (file == server_.files.end()) return refuse({404, "There is no such page."});
    answer(200, file->second.type, file->second.content);
}

void Connection::refuse(const Rejection& refusal) {
    answer(refusal.status, "text/plain; charset=utf-8", refusal.reason);
}

void Connection::answer(unsigned status, std::string_view type, std::string_view content) {
    const auto& request = parser_->get();
    response_ = {};
    response_.version(11);
    response_.result(status);
    response_.set(http::field::content_type, beast::string_view(type.data(), type.size()));
    response_.set(http::field::cache_control, "no-store");
    response_.set("Content-Security-Policy", server_.policy);
    response_.set("Cross-Origin-Opener-Policy", "same-origin");
    response_.set("Cross-Origin-Resource-Policy", "same-origin");
    response_.set("Referrer-Policy", "no-referrer");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("X-Frame-Options", "DENY");
    if (status == 405) response_.set(http::field::allow, "GET, HEAD");
    if (status == 426) response_.set(http::field::upgrade, "websocket");
    response_.content_length(content.size());
    response_.keep_alive(status == 200 && request.keep_alive());
    if (request.method() != http::verb::head) response_.body() = {content.data(), content.size()};
    const auto then = [self = shared_from_this()](error_code error, std::size_t) {
        if (error) return;
        if (self->response_.keep_alive()) return self->read_request();
        self->stream_.next_layer().socket().shutdown(tcp::socket::shutdown_send, error);
        self->stream_.next_layer().expires_after(farewell_time);
        self->wait_for_end();
    };
    http::async_write(stream_.next_layer(), response_, then);
}

/// Reads the rest of a refused request. If the socket were closed with unread bytes, the client
/// would lose the answer.
void Connection::wait_for_end() {
    buffer_.clear();
    const auto then = [self = shared_from_this()](error_code error, std::size_t) {
        if (!error) self->wait_for_end();
    };
    stream_.next_layer().async_read_some(buffer_.prepare(4096), then);
}

void Connection::open_page() {
    if (buffer_.size() > 0) return refuse({400, "A page has to wait for the handshake."});
    if (server_.count_pages() >= server_.limits.pages) {
        return refuse({503, "Too many pages are open."});
    }
    stream_.next_layer().expires_never();  // The WebSocket has another timer.
    stream_.set_option(websocket::stream_base::timeout{server_.limits.request_time,
                                                       server_.limits.idle_time, true});
    stream_.read_message_max(server_.limits.message_bytes);
    stream_.auto_fragment(false);
    stream_.control_callback([this](websocket::frame_type kind, beast::string_view) {
        if (kind == websocket::frame_type::close) expect_end();
    });
    const auto then = [self = shared_from_this()](error_code error) {
        if (error) return;
        self->outbox_ = std::make_shared<Outbox>(self->server_.limits.waiting_text);
        self->page_ = self->server_.add_page({self->outbox_, self});
        self->server_.handlers.opened(self->page_);
        self->read_text();
    };
    stream_.async_accept(parser_->get(), then);
}

void Connection::read_text() {
    const auto then = [self = shared_from_this()](error_code error, std::size_t) {
        if (error || !self->stream_.got_text()) {
            self->close();
            return self->server_.remove_page(self->page_);
        }
        const auto text = self->buffer_.cdata();
        self->server_.handlers.message(self->page_,
                                       {static_cast<const char*>(text.data()), text.size()});
        self->buffer_.clear();
        self->read_text();
    };
    stream_.async_read(buffer_, then);
}

/// Limits how long the server waits after a close. If the page closes first, it gets its answer at
/// once, but it may leave its end of the connection open.
void Connection::expect_end() {
    patience_.expires_after(farewell_time);
    patience_.async_wait([self = shared_from_this()](error_code error) {
        if (!error) self->close();
    });
}

void Connection::send_waiting() {
    if (sending_) return;
    sending_ = outbox_->next();
    if (!sending_) return;
    stream_.text(sending_->is_text);
    const auto then = [self = shared_from_this()](error_code error, std::size_t) {
        self->sending_.reset();
        if (error) return self->close();
        self->send_waiting();
    };
    stream_.async_write(asio::buffer(*sending_->bytes), then);
}

void Connection::say_goodbye() {
    if (page_ == 0) return close();
    stream_.async_close(websocket::close_code::going_away,
                        [self = shared_from_this()](error_code) {});
}

Server::~Server() { stop(); }

Result<void> Server::start() {
    auto digits = secret_digits();
    if (!digits) {
        return failure(
            "the system gives no random numbers, without which the page cannot be protected");
    }
    token = *std::move(digits);
    try {
        if (auto opened = open_doors(); !opened) return opened;
        admission.emplace(port, token);
        // Only this server may supply scripts and styles and be connected to. No other site may
        // embed the page.
        policy = fmt::format(
            "default-src 'self'; img-src 'self' blob: data:; worker-src 'self' blob:; "
            "connect-src 'self' ws://127.0.0.1:{0} ws://localhost:{0}; base-uri 'none'; "
            "form-action 'none'; frame-ancestors 'none'; object-src 'none'",
            port);
        for (tcp::acceptor& door : doors_) accept(door);
        // Signals are blocked in the new thread, so that they reach the threads that expect them.
        sigset_t all, before;
        sigfillset(&all);
        pthread_sigmask(SIG_SETMASK, &all, &before);
        thread_ = std::thread([this] { run(); });
        pthread_sigmask(SIG_SETMASK, &before, nullptr);
    } catch (const std::exception& error) {
        return failure(fmt::format("cannot serve a page: {}", error.what()));
    }
    return {};
}

/// Opens a free port of 127.0.0.1, and the same port of ::1 if the machine has IPv6.
Result<void> Server::open_doors() {
    constexpr int most_tries = 16;
    for (int k = 0; k < most_tries; ++k) {
        doors_.clear();
        tcp::acceptor& four = doors_.emplace_back(io_);
        error_code error;
        four.open(tcp::v4(), error);
        if (!error) four.bind({asio::ip::address_v4::loopback(), 0}, error);
        if (!error) four.listen(asio::socket_base::max_listen_connections, error);
        if (!error) port = four.local_endpoint(error).port();
        if (error) return failure(fmt::format("cannot open a port: {}", error.message()));
        close_on_exec(four);

        tcp::acceptor six(io_);
        six.open(tcp::v6(), error);
        if (!error) six.set_option(asio::ip::v6_only(true), error);
        if (!error) six.bind({asio::ip::address_v6::loopback(), port}, error);
        // If another program had this port of ::1, a browser that tries ::1 first would connect to
        // that program.
        if (error == asio::error::address_in_use) continue;
        if (!error) six.listen(asio::socket_base::max_listen_connections, error);
        if (error) return {};
        close_on_exec(six);
        doors_.push_back(std::move(six));
        return {};
    }
    return failure("cannot open a port: each one that was tried is in use for IPv6");
}

void Server::accept(tcp::acceptor& door) {
    door.async_accept([this, &door](error_code error, tcp::socket socket) {
        if (is_closing_) return;
        // If file descriptors have run out, accepting fails at once. Without this pause, the thread
        // would try again without end.
        if (error) std::this_thread::sleep_for(std::chrono::milliseconds(10));
        if (!error && make_room()) {
            close_on_exec(socket);
            socket.set_option(tcp::no_delay(true), error);
            std::make_shared<Connection>(*this, std::move(socket))->read_request();
        }
        accept(door);
    });
}

/// If there are too many connections, closes the oldest one that is not a page, so that idle
/// clients cannot keep pages out. Returns false if every connection is a page.
bool Server::make_room() {
    if (connections.size() < limits.connections) return true;
    Connection* oldest = nullptr;
    for (Connection* each : connections) {
        if (!each->is_stranger()) continue;
        if (oldest == nullptr || each->number < oldest->number) oldest = each;
    }
    if (oldest != nullptr) oldest->close();
    return oldest != nullptr;
}

void Server::run() {
    server_of_this_thread = this;
    while (!is_closing_) io_.run_one();
    io_.run_for(farewell_time);
    for (Connection* connection : connections) connection->close();
    while (count_pages() > 0) remove_page(pages_.begin()->first);
}

void Server::close_all() {
    if (std::exchange(is_closing_, true)) return;
    for (tcp::acceptor& door : doors_) {
        error_code ignored;
        door.close(ignored);
    }
    for (Connection* connection : connections) connection->say_goodbye();
}

void Server::stop() {
    asio::post(io_, [this] { close_all(); });
    if (server_of_this_thread == this) return;
    const std::lock_guard lock(stop_mutex_);
    if (thread_.joinable()) thread_.join();
}

template <typename Add>
void Server::send(PageId page, const Add& add) {
    const std::lock_guard lock(pages_mutex_);
    const auto line = pages_.find(page);
    if (line == pages_.end()) return;
    const Outbox::Added added = add(*line->second.outbox);
    if (added == Outbox::Added::awake) return;
    const bool is_full = added == Outbox::Added::overflow;
    asio::post(io_, [connection = line->second.connection, is_full] {
        const auto self = connection.lock();
        if (!self) return;
        if (is_full) return self->close();
        self->send_waiting();
    });
}

std::size_t Server::count_pages() {
    const std::lock_guard lock(pages_mutex_);
    return pages_.size();
}

PageId Server::add_page(PageLine line) {
    const std::lock_guard lock(pages_mutex_);
    pages_.emplace(++last_page_, std::move(line));
    return last_page_;
}

void Server::remove_page(PageId page) {
    {
        const std::lock_guard lock(pages_mutex_);
        if (pages_.erase(page) == 0) return;
    }
    handlers.closed(page);
}

}  // namespace

struct LocalServer::State : Server {
    using Server::Server;
};

LocalServer::LocalServer(std::unique_ptr<State> state) : state_(std::move(state)) {}
LocalServer::LocalServer(LocalServer&&) noexcept = default;
LocalServer& LocalServer::operator=(LocalServer&&) noexcept = default;
LocalServer::~LocalServer() = default;

Result<LocalServer> LocalServer::start(PageFiles files, PageHandlers handlers,
                                       const ServerLimits& limits) {
    auto state = std::make_unique<State>(std::move(files), std::move(handlers), limits);
    if (auto started = state->start(); !started) return tl::unexpected(started.error());
    return LocalServer(std::move(state));
}

std::uint16_t LocalServer::port() const { return state_->port; }
const std::string& LocalServer::token() const { return state_->token; }

std::string LocalServer::address() const {
    return fmt::format("http://127.0.0.1:{}/#token={}", port(), token());
}

void LocalServer::send_text(PageId page, std::string text) {
    state_->send(page, [&](Outbox& outbox) { return outbox.add_text(std::move(text)); });
}

void LocalServer::send_frame(PageId page, int kind, SharedBytes bytes) {
    state_->send(page, [&](Outbox& outbox) { return outbox.add_frame(kind, std::move(bytes)); });
}

void LocalServer::stop() { state_->stop(); }

}  // namespace cascade
