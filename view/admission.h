// Decides which requests the local server answers. It answers requests of its page, but not
// requests of other sites or other users.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cascade {

/// Whether two secrets are equal. The time of the comparison depends only on their lengths, so that
/// nobody can guess a secret digit by digit.
bool same_secret(std::string_view a, std::string_view b);

/// The parts of a request that decide its admission. A header that is missing or repeated has no
/// value.
struct RequestHead {
    std::string_view method;
    std::string_view target;
    std::optional<std::string_view> host;
    std::optional<std::string_view> origin;
    bool has_origin = false;  ///< Whether there is at least one Origin header.
    bool is_upgrade = false;  ///< Whether the request opens a WebSocket.
};

/// The part of a request's target before the first '?'.
std::string_view path_of(std::string_view target);

/// An HTTP status and a sentence that gives the reason.
struct Rejection {
    unsigned status = 0;
    std::string_view reason;
};

/// The path of the WebSocket, to which the page appends the token as "?token=…".
inline constexpr std::string_view socket_path = "/session";

class Admission {
public:
    Admission(std::uint16_t port, std::string token);

    /// The reason why a request is refused. Empty if it is admitted.
    ///
    /// A foreign site can make its own host name resolve to 127.0.0.1 and then read this server's
    /// page. So `Host` must be a loopback address or `localhost`, with the server's port. Other
    /// names of this machine are refused. Scripts of any site can open a WebSocket. So the request
    /// for a WebSocket must have the server as its `Origin`, and must contain the token.
    std::optional<Rejection> refuse(const RequestHead& head) const;

private:
    bool is_own(std::string_view host) const;

    std::string port_;
    std::string socket_target_;
};

}  // namespace cascade
