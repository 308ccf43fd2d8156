// The loop of the server: one thread, which waits only for input.
#include "lsp/serve.h"

#include "lsp/frames.h"
#include "lsp/server.h"

#include <poll.h>
#include <unistd.h>

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <string_view>

namespace cascade::lsp {
namespace {

Result<void> send(int out, std::string_view message) {
    const std::string whole = framed(message);
    for (std::size_t done = 0; done < whole.size();) {
        const ssize_t count = ::write(out, whole.data() + done, whole.size() - done);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) {
            return failure(fmt::format("the editor takes no answers: {}", std::strerror(errno)));
        }
        done += static_cast<std::size_t>(count);
    }
    return {};
}

Result<void> send_all(int out, const std::vector<std::string>& messages) {
    for (const std::string& message : messages) {
        if (auto sent = send(out, message); !sent) return sent;
    }
    return {};
}

bool is_input_waiting(int in) {
    pollfd input{in, POLLIN, 0};
    return ::poll(&input, 1, 0) > 0;
}

/// Reads bytes. Returns their number, or 0 at the end of the stream.
Result<std::size_t> read_some(int in, std::array<char, 65536>& buffer) {
    for (;;) {
        const ssize_t count = ::read(in, buffer.data(), buffer.size());
        if (count >= 0) return static_cast<std::size_t>(count);
        if (errno != EINTR) {
            return failure(fmt::format("the input cannot be read: {}", std::strerror(errno)));
        }
    }
}

}  // namespace

Result<bool> serve(int in, int out) {
    LanguageServer server;
    FrameReader frames;
    std::array<char, 65536> buffer{};
    for (;;) {
        while (const auto frame = frames.next()) {
            const std::vector<std::string> answers =
                frame->is_too_large ? std::vector{LanguageServer::refuse_large_message()}
                                    : server.receive(frame->body);
            if (auto sent = send_all(out, answers); !sent) return tl::unexpected(sent.error());
            if (server.has_ended()) return server.is_shut_down();
        }
        if (!frames.fault().empty()) {
            return failure(fmt::format("the input is not a stream of messages: {}", frames.fault()),
                           "editors start 'cascade lsp'; docs/editors.md says how");
        }
        if (!is_input_waiting(in)) {
            if (auto sent = send_all(out, server.publish()); !sent)
                return tl::unexpected(sent.error());
        }
        const auto count = read_some(in, buffer);
        if (!count) return tl::unexpected(count.error());
        if (*count == 0) {
            if (auto sent = send_all(out, server.publish()); !sent)
                return tl::unexpected(sent.error());
            return server.is_shut_down();
        }
        frames.add({buffer.data(), *count});
    }
}

}  // namespace cascade::lsp
