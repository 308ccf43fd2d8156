// Decodes and encodes bytes as %XX (RFC 3986, RFC 8089).
#include "lsp/file_uri.h"

#include <fmt/format.h>

#include <charconv>

namespace cascade::lsp {

std::optional<std::filesystem::path> path_of_uri(std::string_view uri) {
    constexpr std::string_view scheme = "file://";
    if (!uri.starts_with(scheme)) return std::nullopt;
    uri.remove_prefix(scheme.size());
    if (uri.starts_with("localhost/")) uri.remove_prefix(std::string_view("localhost").size());
    if (!uri.starts_with('/')) return std::nullopt;
    std::string path;
    for (std::size_t k = 0; k < uri.size(); ++k) {
        unsigned char byte = static_cast<unsigned char>(uri[k]);
        if (byte == '%') {
            if (k + 2 >= uri.size()) return std::nullopt;
            const char* const digits = uri.data() + k + 1;
            if (std::from_chars(digits, digits + 2, byte, 16).ptr != digits + 2)
                return std::nullopt;
            k += 2;
        }
        if (byte == 0) return std::nullopt;
        path += static_cast<char>(byte);
    }
    return path;
}

std::string uri_of_path(const std::filesystem::path& path) {
    std::string uri = "file://";
    std::error_code error;
    const auto whole = std::filesystem::absolute(path, error);
    for (const char c : (error ? path : whole).lexically_normal().string()) {
        const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                              (c >= '0' && c <= '9') ||
                              std::string_view("/-._~").find(c) != std::string_view::npos;
        uri += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return uri;
}

}  // namespace cascade::lsp
