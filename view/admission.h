// Decides which requests the local server answers: only its own page's, and no other site's or
// user's.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cascade {

/// Whether two secrets are equal. The time depends only on their lengths, so that guesses cannot be
/// improved digit by digit.
bool same_secret(std::string_view a, std::string_view b);

/// The facts that decide admission. A header that is missing or repeated has no value.
struct RequestHead {
    std::string_view method;
    std::string_view target;
    std::optional<std::string_view> host;
    std::optional<std::string_view> origin;
    bool has_origin = false;  ///< At least one Origin header.
    bool is_upgrade = false;  ///< It asks for a WebSocket.
};

/// The part of a request's target before the first '?'.
std::string_view path_of(std::string_view target);

/// An HTTP status and a sentence that gives the reason.
struct Rejection {
    unsigned status = 0;
    std::string_view reason;
};

/// The path of the WebSocket. Takes the token as "?token=…".
inline constexpr std::string_view socket_path = "/session";

class Admission {
public:
    Admission(std::uint16_t port, std::string token);

    /// Why a request is refused; nullopt if it is admitted.
    ///
    /// A site whose name is rebound to 127.0.0.1 could read the page as its own, so `Host` must be
    /// a loopback address or `localhost`, with the server's port, and no other name that resolves
    /// to this machine. Scripts of every site may open a WebSocket, so its `Origin` must be the
    /// server, and it must know the token.
    std::optional<Rejection> refuse(const RequestHead& head) const;

private:
    bool is_own(std::string_view host) const;

    std::string port_;
    std::string socket_target_;
};

}  // namespace cascade
