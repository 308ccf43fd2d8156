// A client of the local server that sends any bytes, and the WebSocket frames (RFC 6455) that tests
// need.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace cascade {

/// The request that opens a page's WebSocket. The key is that of RFC 6455.
inline std::string socket_request(std::string_view host, std::string_view token,
                                  std::string_view origin) {
    return fmt::format(
        "GET /session?token={} HTTP/1.1\r\nHost: {}\r\nOrigin: {}\r\nUpgrade: websocket\r\n"
        "Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n",
        token, host, origin);
}

class RawClient {
public:
    enum class Family { four, six };

    explicit RawClient(std::uint16_t port, Family family = Family::four) {
        sockaddr_storage place = {};
        socklen_t size = 0;
        if (family == Family::four) {
            auto& four = reinterpret_cast<sockaddr_in&>(place);
            four = {AF_INET, htons(port), {htonl(INADDR_LOOPBACK)}, {}};
            size = sizeof four;
        } else {
            auto& six = reinterpret_cast<sockaddr_in6&>(place);
            six = {AF_INET6, htons(port), 0, IN6ADDR_LOOPBACK_INIT, 0};
            size = sizeof six;
        }
        socket_ = ::socket(place.ss_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
        // The buffer is small, so that the server soon has to wait for its reader. Waiting is
        // limited, so that no test hangs.
        const int buffer = 4096;
        ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &buffer, sizeof buffer);
        const timeval limit = {20, 0};
        ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
        ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
        is_connected_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&place), size) == 0;
    }
    ~RawClient() { ::close(socket_); }
    RawClient(const RawClient&) = delete;
    RawClient& operator=(const RawClient&) = delete;

    bool is_connected() const { return is_connected_; }

    bool send(std::string_view bytes) {
        while (!bytes.empty()) {
            const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
            if (sent <= 0) return false;
            bytes.remove_prefix(static_cast<std::size_t>(sent));
        }
        return true;
    }

    /// Returns all bytes until the other side closes.
    std::string read_all() {
        std::string all;
        while (read_some(all)) {
        }
        return all;
    }

    /// Returns `count` bytes, or fewer if the other side closes first.
    std::string read(std::size_t count) {
        while (rest_.size() < count && read_some(rest_)) {
        }
        std::string wanted = rest_.substr(0, count);
        rest_.erase(0, wanted.size());
        return wanted;
    }

    /// Returns the bytes up to and including `end`.
    std::string read_until(std::string_view end) {
        while (rest_.find(end) == std::string::npos) {
            if (!read_some(rest_)) return read(rest_.size());
        }
        return read(rest_.find(end) + end.size());
    }

    /// Sends a masked frame, as clients must. The mask is 0, so the payload does not change.
    bool send_frame(int opcode, std::string_view payload) {
        std::string frame(1, static_cast<char>(0x80 | opcode));
        const std::size_t size = payload.size();
        const int size_bytes = size < 126 ? 0 : size < 65536 ? 2 : 8;
        frame += static_cast<char>(0x80 | (size_bytes == 0 ? size : size_bytes == 2 ? 126 : 127));
        for (int k = size_bytes - 1; k >= 0; --k) frame += static_cast<char>(size >> (8 * k));
        frame.append(4, '\0');
        frame += payload;
        return send(frame);
    }

    struct Frame {
        int opcode = 0;  ///< 0 if the other side closed.
        std::string payload;
    };
    static constexpr int text = 1;
    static constexpr int binary = 2;
    static constexpr int goodbye = 8;

    Frame read_frame() {
        const std::string head = read(2);
        if (head.size() < 2) return {};
        std::uint64_t size = head[1] & 0x7f;
        const int size_bytes = size == 126 ? 2 : size == 127 ? 8 : 0;
        if (size_bytes > 0) size = 0;
        for (const char byte : read(static_cast<std::size_t>(size_bytes))) {
            size = size << 8 | static_cast<unsigned char>(byte);
        }
        return {head[0] & 0xf, read(size)};
    }

private:
    bool read_some(std::string& into) {
        char bytes[65536];
        const ssize_t count = ::recv(socket_, bytes, sizeof bytes, 0);
        if (count <= 0) return false;
        into.append(bytes, static_cast<std::size_t>(count));
        return true;
    }

    int socket_ = -1;
    bool is_connected_ = false;
    std::string rest_;
};

}  // namespace cascade
