// Which requests the local server answers: those of its own page, and of no other site or user.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cascade {

/// Whether two secrets are equal. The time depends on their lengths alone, so that guesses cannot
/// be improved digit by digit.
bool same_secret(std::string_view a, std::string_view b);

/// What admission depends on. A header that is missing or comes twice has no value.
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

/// An HTTP status and a sentence that says why.
struct Rejection {
    unsigned status = 0;
    std::string_view reason;
};

/// The path of the WebSocket. It takes the token as "?token=…".
inline constexpr std::string_view socket_path = "/session";

class Admission {
public:
    Admission(std::uint16_t port, std::string token);

    /// Why a request is refused; nothing if it is admitted.
    ///
    /// Names that resolve to this machine are not its addresses: a site whose name is rebound to
    /// 127.0.0.1 would otherwise read the page as its own, so `Host` must be a loopback address or
    /// `localhost`, with the server's port. A WebSocket may be opened by scripts of every site, so
    /// its `Origin` must be the server, and it must know the token.
    std::optional<Rejection> refuse(const RequestHead& head) const;

private:
    bool is_own(std::string_view host) const;

    std::string port_;
    std::string socket_target_;
};

}  // namespace cascade
