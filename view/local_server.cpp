// Opens the port, accepts connections, and passes messages between the server's thread and others.
#include "view/local_server.h"

#include "core/temporary_file.h"
#include "view/server.h"

#include <boost/asio/ip/v6_only.hpp>
#include <boost/asio/post.hpp>
#include <fmt/format.h>

#include <csignal>
#include <fcntl.h>
#include <utility>

namespace cascade {

namespace serving {

namespace {

/// The server that the current thread belongs to. Null in threads that belong to no server.
thread_local const void* server_of_this_thread = nullptr;

/// Prevents programs that are started to show the page from inheriting the port.
template <typename Socket>
void close_on_exec(Socket& socket) {
    ::fcntl(socket.native_handle(), F_SETFD, FD_CLOEXEC);
}

}  // namespace

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
        // The page may load scripts and styles only from this server, and connect only to it. No
        // other site may embed the page.
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
        // If file descriptors have run out, each attempt to accept a connection fails at once.
        // Without this pause, the thread would try again without end.
        if (error) std::this_thread::sleep_for(std::chrono::milliseconds(10));
        if (!error && make_room()) {
            close_on_exec(socket);
            socket.set_option(tcp::no_delay(true), error);
            std::make_shared<Connection>(*this, std::move(socket))->read_request();
        }
        accept(door);
    });
}

/// Makes room for a connection. If there are too many, closes the oldest connection that is not a
/// page, so that idle clients cannot keep pages out. Returns false if every connection is a page.
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

}  // namespace serving

struct LocalServer::State : serving::Server {
    using serving::Server::Server;
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
