// Answers the requests of a connection, and carries the messages of its page.
#include "view/server.h"

#include <utility>

namespace cascade::serving {

namespace {

std::string_view view_of(beast::string_view text) { return {text.data(), text.size()}; }

std::optional<std::string_view> only_value(const http::fields& fields, http::field name) {
    if (fields.count(name) != 1) return std::nullopt;
    return view_of(fields[name]);
}

}  // namespace

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

}  // namespace cascade::serving
