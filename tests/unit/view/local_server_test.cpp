// The local server from outside: raw sockets send bytes that browsers, other sites and strangers
// may send.
#include "view/local_server.h"

#include "unit/view/raw_client.h"

#include <gmock/gmock.h>

#include <condition_variable>
#include <fmt/format.h>
#include <thread>

namespace cascade {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// The calls of handlers, as text.
class Events {
public:
    void add(std::string event) {
        const std::lock_guard lock(mutex_);
        all_.push_back(std::move(event));
        came_.notify_all();
    }
    /// Waits until there are `count` events.
    std::vector<std::string> wait_for(std::size_t count) {
        std::unique_lock lock(mutex_);
        came_.wait_for(lock, 20s, [&] { return all_.size() >= count; });
        return all_;
    }

private:
    std::mutex mutex_;
    std::condition_variable came_;
    std::vector<std::string> all_;
};

class LocalServerTest : public testing::Test {
protected:
    void start(const ServerLimits& limits = {}) {
        PageFiles files;
        files["/"] = {"text/html; charset=utf-8", "<!doctype html><title>page</title>"};
        files["/page.js"] = {"text/javascript; charset=utf-8", "let x;"};
        PageHandlers handlers;
        handlers.opened = [this](PageId page) { events_.add(fmt::format("opened {}", page)); };
        handlers.closed = [this](PageId page) { events_.add(fmt::format("closed {}", page)); };
        handlers.message = [this](PageId page, std::string_view text) {
            if (text.size() > 100) text = "long";
            events_.add(fmt::format("{}: {}", page, text));
            if (text == "stop") server_->stop();
            if (text == "echo") server_->send_text(page, "echo");
        };
        auto started = LocalServer::start(std::move(files), std::move(handlers), limits);
        ASSERT_TRUE(started.has_value()) << started.error().message;
        server_.emplace(std::move(*started));
        own_ = fmt::format("127.0.0.1:{}", server_->port());
    }

    /// Sends bytes after which the server closes the connection, and returns the whole answer.
    std::string answer_to(std::string_view request) {
        RawClient client(server_->port());
        EXPECT_TRUE(client.send(request));
        return client.read_all();
    }

    /// Sends a request that begins with this line and the right host, and ends with these headers.
    /// Returns the answer.
    std::string answer_to(std::string_view line, std::string_view headers) {
        return answer_to(fmt::format("{} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n{}\r\n", line,
                                     own_, headers));
    }

    std::string handshake(std::string_view token, std::string_view origin) const {
        return socket_request(own_, token, origin);
    }

    /// Opens the WebSocket of a page with this client.
    void open_page(RawClient& client) {
        ASSERT_TRUE(client.send(handshake(server_->token(), "http://" + own_)));
        const std::string answer = client.read_until("\r\n\r\n");
        ASSERT_THAT(answer, StartsWith("HTTP/1.1 101 "));
        // The key and the answer to it are the example of RFC 6455.
        ASSERT_THAT(answer, HasSubstr("Sec-WebSocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo=\r\n"));
    }

    Events events_;
    std::optional<LocalServer> server_;
    std::string own_;  ///< The server's host.
};

TEST_F(LocalServerTest, ServesItsFiles) {
    start();
    const std::string page = answer_to("GET /", "");
    EXPECT_THAT(page, StartsWith("HTTP/1.1 200 OK\r\n"));
    EXPECT_THAT(page, testing::EndsWith("\r\n\r\n<!doctype html><title>page</title>"));
    EXPECT_THAT(page, HasSubstr("\r\nContent-Type: text/html; charset=utf-8\r\n"));
    const std::string script = answer_to("GET /page.js?v=1", "Origin: http://" + own_ + "\r\n");
    EXPECT_THAT(script, StartsWith("HTTP/1.1 200 OK\r\n"));
    EXPECT_THAT(script, testing::EndsWith("\r\n\r\nlet x;"));
    const std::string head = answer_to("HEAD /page.js", "");
    EXPECT_THAT(head, StartsWith("HTTP/1.1 200 OK\r\n"));
    EXPECT_THAT(head, HasSubstr("\r\nContent-Length: 6\r\n"));
    EXPECT_THAT(head, testing::EndsWith("\r\n\r\n"));
    EXPECT_EQ(server_->address(), fmt::format("http://{}/#token={}", own_, server_->token()));
}

TEST_F(LocalServerTest, AnswersSeveralRequestsOfOneConnection) {
    start();
    RawClient client(server_->port());
    const std::string request = fmt::format("GET /page.js HTTP/1.1\r\nHost: {}\r\n\r\n", own_);
    for (int k = 0; k < 3; ++k) {
        ASSERT_TRUE(client.send(request));
        EXPECT_THAT(client.read_until("let x;"), StartsWith("HTTP/1.1 200 OK\r\n"));
    }
    ASSERT_TRUE(client.send(request + request));
    EXPECT_THAT(client.read_until("let x;"), StartsWith("HTTP/1.1 200 OK\r\n"));
    EXPECT_THAT(client.read_until("let x;"), StartsWith("HTTP/1.1 200 OK\r\n"));
}

TEST_F(LocalServerTest, TellsBrowsersToTrustNobodyElse) {
    start();
    for (const std::string& answer :
         {answer_to("GET /", ""), answer_to("GET /nowhere", ""), answer_to("POST /", "")}) {
        for (const std::string_view header :
             {"Content-Security-Policy: default-src 'self'; ", "; frame-ancestors 'none'; ",
              "Referrer-Policy: no-referrer\r\n", "X-Frame-Options: DENY\r\n",
              "X-Content-Type-Options: nosniff\r\n", "Cache-Control: no-store\r\n",
              "Cross-Origin-Resource-Policy: same-origin\r\n"}) {
            EXPECT_THAT(answer, HasSubstr(header));
        }
        EXPECT_THAT(answer, Not(HasSubstr("Access-Control-")));
        EXPECT_THAT(answer, Not(HasSubstr("unsafe")));
        EXPECT_THAT(answer, Not(HasSubstr(server_->token())));
    }
}

TEST_F(LocalServerTest, RefusesWhatIsNotForIt) {
    start();
    const auto refused = [this](std::string_view request, std::string_view status) {
        EXPECT_THAT(answer_to(request), StartsWith(fmt::format("HTTP/1.1 {} ", status))) << request;
    };
    const std::string host = "Host: " + own_ + "\r\n";
    refused("GET / HTTP/1.1\r\n\r\n", "403");
    refused("GET / HTTP/1.1\r\nHost: rebound.example\r\n\r\n", "403");
    refused(fmt::format("GET / HTTP/1.1\r\nHost: rebound.example:{}\r\n\r\n", server_->port()),
            "403");
    refused("GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n", "403");
    refused("GET / HTTP/1.1\r\n" + host + host + "\r\n", "403");
    refused("GET / HTTP/1.1\r\n" + host + "Origin: http://other.example\r\n\r\n", "403");
    refused("GET /../etc/passwd HTTP/1.1\r\n" + host + "\r\n", "404");
    refused("GET http://" + own_ + "/ HTTP/1.1\r\n" + host + "\r\n", "404");
    refused("GET /session HTTP/1.1\r\n" + host + "\r\n", "426");
    for (const std::string_view method : {"POST", "PUT", "DELETE", "OPTIONS", "TRACE", "PATCH"}) {
        refused(fmt::format("{} / HTTP/1.1\r\n{}\r\n", method, host), "405");
    }
    refused("POST / HTTP/1.1\r\n" + host + "Content-Length: 3\r\n\r\nabc", "405");
    refused("GET / HTTP/1.1\r\n" + host + "Content-Length: 3\r\n\r\nabc", "413");
    refused("GET / HTTP/1.1\r\n" + host + "Transfer-Encoding: chunked\r\n\r\n", "413");
    refused("GET / HTTP/1.1\r\n" + host + "X: " + std::string(10000, 'x') + "\r\n\r\n", "431");
    refused("GET /" + std::string(1000000, 'x'), "431");
    refused("\x16\x03\x01 this is TLS\r\n\r\n", "400");
    refused("GET / HTTP/1.1\r\nno colon\r\n\r\n", "400");
    refused("GET / HTTP/1.1\r\n" + host + "Content-Length: -1\r\n\r\n", "400");
    EXPECT_THAT(events_.wait_for(0), ElementsAre());
}

TEST_F(LocalServerTest, RefusesSocketsOfStrangers) {
    start();
    const std::string own = "http://" + own_;
    const std::string& token = server_->token();
    EXPECT_THAT(answer_to(handshake("", own)), StartsWith("HTTP/1.1 403 "));
    EXPECT_THAT(answer_to(handshake(token.substr(1), own)), StartsWith("HTTP/1.1 403 "));
    EXPECT_THAT(answer_to(handshake(std::string(32, '0'), own)), StartsWith("HTTP/1.1 403 "));
    EXPECT_THAT(answer_to(handshake(token, "http://other.example")), StartsWith("HTTP/1.1 403 "));
    EXPECT_THAT(answer_to(handshake(token, "null")), StartsWith("HTTP/1.1 403 "));
    EXPECT_THAT(answer_to(handshake(token, own) + "\x81"), StartsWith("HTTP/1.1 400 "))
        << "a frame before the handshake was answered";
    EXPECT_THAT(events_.wait_for(0), ElementsAre());
}

TEST_F(LocalServerTest, TalksWithPages) {
    start();
    std::optional<RawClient> first(server_->port());
    RawClient second(server_->port());
    open_page(*first);
    ASSERT_TRUE(first->send_frame(RawClient::text, "hello"));
    events_.wait_for(2);
    open_page(second);
    ASSERT_TRUE(second.send_frame(RawClient::text, "echo"));
    EXPECT_EQ(second.read_frame().payload, "echo");
    EXPECT_THAT(events_.wait_for(4), ElementsAre("opened 1", "1: hello", "opened 2", "2: echo"));

    server_->send_text(1, "one");
    server_->send_text(1, "two");
    EXPECT_EQ(first->read_frame().payload, "one");
    EXPECT_EQ(first->read_frame().payload, "two");
    const auto bytes = std::make_shared<const std::string>(100000, '\xff');
    server_->send_frame(1, 0, bytes);
    const RawClient::Frame frame = first->read_frame();
    EXPECT_EQ(frame.opcode, RawClient::binary);
    EXPECT_EQ(frame.payload, *bytes);

    ASSERT_TRUE(first->send_frame(RawClient::goodbye, ""));
    EXPECT_EQ(first->read_frame().opcode, RawClient::goodbye);
    EXPECT_EQ(first->read_all(), "");
    first.reset();
    EXPECT_THAT(events_.wait_for(5).back(), "closed 1");
    server_->send_text(1, "nobody hears it");
    server_->send_text(17, "nobody was it");
}

TEST_F(LocalServerTest, APageThatHasSaidGoodbyeIsGoneWhenItKeepsItsConnection) {
    start();
    RawClient page(server_->port());
    open_page(page);
    events_.wait_for(1);
    ASSERT_TRUE(page.send_frame(RawClient::goodbye, ""));
    EXPECT_EQ(page.read_frame().opcode, RawClient::goodbye);
    // The page is closed at once, long before a silent page would be.
    EXPECT_THAT(events_.wait_for(2), ElementsAre("opened 1", "closed 1"));
}

TEST_F(LocalServerTest, ClosesPagesThatBreakTheRules) {
    ServerLimits limits;
    limits.message_bytes = 1000;
    limits.waiting_text = 100000;
    start(limits);
    std::size_t count = 0;
    const auto breaks = [&](const auto& act) {
        count += 2;
        {
            RawClient client(server_->port());
            open_page(client);
            events_.wait_for(count - 1);  // The server has opened the page now.
            act(client);
        }
        EXPECT_THAT(events_.wait_for(count).back(), StartsWith("closed"));
    };
    const auto is_closed_after = [](RawClient& page, int opcode, const std::string& payload) {
        page.send_frame(opcode, payload);
        page.read_all();
    };
    breaks([&](RawClient& page) {
        page.send_frame(RawClient::text, std::string(1000, 'x'));
        EXPECT_THAT(events_.wait_for(count++).back(), "1: long");
        is_closed_after(page, RawClient::text, std::string(1001, 'x'));
    });
    breaks([&](RawClient& page) { is_closed_after(page, RawClient::binary, "bytes"); });
    breaks([&](RawClient& page) { is_closed_after(page, RawClient::text, "\xc0\x80"); });
    breaks([&](RawClient& page) { is_closed_after(page, 7, "a reserved opcode"); });
    breaks([](RawClient& page) {
        page.send(std::string("\x81\x01x", 3));  // Not masked.
        page.read_all();
    });
    breaks([&](RawClient& page) {
        for (int k = 0; k < 1000; ++k) server_->send_text(6, std::string(90000, 'x'));
        page.read_all();
    });
}

TEST_F(LocalServerTest, SlowReaderGetsTheNewestFrame) {
    start();
    RawClient page(server_->port());
    open_page(page);
    events_.wait_for(1);
    // The frame is larger than the buffers of the two sockets, so later frames have to wait.
    server_->send_frame(1, 0, std::make_shared<const std::string>(std::size_t{64} << 20, 'x'));
    for (int k = 1; k <= 1000; ++k) {
        server_->send_frame(1, 1, std::make_shared<const std::string>(fmt::format("frame {}", k)));
    }
    server_->send_text(1, "done");
    std::vector<std::string> payloads;
    for (int k = 0; k < 3; ++k) {
        const RawClient::Frame frame = page.read_frame();
        payloads.push_back(frame.payload.size() > 100 ? "large" : frame.payload);
    }
    // The text is sent first, unless the large frame is being sent already.
    EXPECT_THAT(payloads, testing::UnorderedElementsAre("large", "done", "frame 1000"));
    EXPECT_EQ(payloads.back(), "frame 1000");
}

TEST_F(LocalServerTest, SilentConnectionsBlockNobody) {
    ServerLimits limits;
    limits.request_time = 200ms;
    start(limits);
    std::vector<std::unique_ptr<RawClient>> silent;
    for (int k = 0; k < 40; ++k) {
        silent.push_back(std::make_unique<RawClient>(server_->port()));
        if (k % 2 == 0) silent.back()->send("GET / HTTP/1.1\r\nHost: 127");
    }
    EXPECT_THAT(answer_to("GET /", ""), StartsWith("HTTP/1.1 200 OK\r\n"));
    for (const auto& client : silent) EXPECT_EQ(client->read_all(), "") << "it was to be closed";
}

TEST_F(LocalServerTest, BoundsConnectionsAndPages) {
    ServerLimits limits;
    limits.connections = 4;
    limits.pages = 2;
    start(limits);
    RawClient first(server_->port()), second(server_->port());
    open_page(first);
    open_page(second);
    events_.wait_for(2);
    const std::string request = handshake(server_->token(), "http://" + own_);
    EXPECT_THAT(answer_to(request), StartsWith("HTTP/1.1 503 "));
    RawClient third(server_->port()), fourth(server_->port());
    const std::string get = fmt::format("GET /page.js HTTP/1.1\r\nHost: {}\r\n\r\n", own_);
    for (RawClient* client : {&third, &fourth}) {
        client->send(get);
        EXPECT_THAT(client->read_until("let x;"), StartsWith("HTTP/1.1 200 OK\r\n"));
    }
    // The oldest connection that is no page is closed to make room, so that idle strangers lock
    // nobody out.
    RawClient fifth(server_->port());
    fifth.send(get);
    EXPECT_THAT(fifth.read_until("let x;"), StartsWith("HTTP/1.1 200 OK\r\n"));
    EXPECT_EQ(third.read_all(), "");
    RawClient sixth(server_->port()), seventh(server_->port());
    EXPECT_EQ(fourth.read_all(), "");
    EXPECT_EQ(fifth.read_all(), "");
}

TEST_F(LocalServerTest, ListensToNobodyElse) {
    start();
    const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    // 127.0.0.2 is this machine, too, but a socket bound to 127.0.0.1 gets no connections to it.
    const sockaddr_in place = {AF_INET, htons(server_->port()), {htonl(0x7f000002)}, {}};
    EXPECT_NE(::connect(socket, reinterpret_cast<const sockaddr*>(&place), sizeof place), 0);
    ::close(socket);
    RawClient six(server_->port(), RawClient::Family::six);
    if (!six.is_connected()) return;  // A machine without IPv6.
    six.send(fmt::format("GET / HTTP/1.1\r\nHost: [::1]:{}\r\nConnection: close\r\n\r\n",
                         server_->port()));
    EXPECT_THAT(six.read_all(), StartsWith("HTTP/1.1 200 OK\r\n"));
}

TEST_F(LocalServerTest, StopsFromAnyThread) {
    start();
    RawClient page(server_->port()), deaf(server_->port()), silent(server_->port());
    open_page(page);
    open_page(deaf);
    events_.wait_for(2);
    std::vector<std::thread> threads;
    for (int k = 0; k < 4; ++k) {
        threads.emplace_back([this, k] {
            for (int i = 0; i < 200; ++i) {
                server_->send_text(1 + k % 2, "text");
                server_->send_frame(1 + k % 2, k, std::make_shared<const std::string>(1000, 'x'));
            }
            server_->stop();
        });
    }
    while (page.read_frame().opcode != RawClient::goodbye) {
    }
    for (std::thread& thread : threads) thread.join();
    const auto events = events_.wait_for(4);
    EXPECT_THAT(events, testing::IsSupersetOf({"closed 1", "closed 2"}));
    EXPECT_EQ(events.size(), 4U);
    EXPECT_FALSE(RawClient(server_->port()).is_connected());
    server_->stop();
}

TEST_F(LocalServerTest, StopsFromItsOwnHandler) {
    start();
    RawClient page(server_->port());
    open_page(page);
    page.send_frame(RawClient::text, "stop");
    EXPECT_EQ(page.read_frame().opcode, RawClient::goodbye);
    EXPECT_THAT(events_.wait_for(3), ElementsAre("opened 1", "1: stop", "closed 1"));
}

}  // namespace
}  // namespace cascade
