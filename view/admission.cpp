// Checks the rules of admission one after the other.
#include "view/admission.h"

#include <fmt/format.h>

namespace cascade {

bool same_secret(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    // Volatile, so that compilers cannot end the loop early.
    volatile unsigned char difference = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        difference = static_cast<unsigned char>(difference | (a[k] ^ b[k]));
    }
    return difference == 0;
}

std::string_view path_of(std::string_view target) { return target.substr(0, target.find('?')); }

Admission::Admission(std::uint16_t port, std::string token)
    : port_(fmt::format(":{}", port)),
      socket_target_(fmt::format("{}?token={}", socket_path, token)) {}

bool Admission::is_own(std::string_view host) const {
    for (const std::string_view name : {"127.0.0.1", "localhost", "[::1]"}) {
        if (host.starts_with(name) && host.substr(name.size()) == port_) return true;
    }
    return false;
}

std::optional<Rejection> Admission::refuse(const RequestHead& head) const {
    if (!head.host || !is_own(*head.host)) {
        return Rejection{403, "This server answers only to its own address on this machine."};
    }
    if (head.method != "GET" && head.method != "HEAD") {
        return Rejection{405, "This server answers only GET and HEAD."};
    }
    constexpr std::string_view scheme = "http://";
    const bool is_own_origin = head.origin && head.origin->starts_with(scheme) &&
                               head.origin->substr(scheme.size()) == *head.host;
    if ((head.has_origin || head.is_upgrade) && !is_own_origin) {
        return Rejection{403, "This server answers only its own page."};
    }
    if (!head.is_upgrade) {
        if (path_of(head.target) != socket_path) return std::nullopt;
        return Rejection{426, "This address takes only WebSockets."};
    }
    if (path_of(head.target) != socket_path) return Rejection{404, "There is no WebSocket here."};
    if (head.method != "GET" || !same_secret(head.target, socket_target_)) {
        return Rejection{403, "The token is wrong: open the address that Cascade printed."};
    }
    return std::nullopt;
}

}  // namespace cascade
