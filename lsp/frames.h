// Messages in a stream of bytes. Each has a header that contains its length (Language Server
// Protocol 3.17, "Base Protocol").
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace cascade::lsp {

/// The largest message that is read, in bytes. It is large enough for a script of the largest size,
/// even if many characters are escaped.
inline constexpr std::size_t largest_message = std::size_t{64} << 20;
inline constexpr std::size_t largest_header = 4096;

/// A message with its header.
std::string framed(std::string_view body);

/// Splits a stream into messages.
class FrameReader {
public:
    struct Frame {
        std::string body;  ///< Empty if `is_too_large`.
        bool is_too_large = false;
    };

    /// Appends bytes of the stream.
    void add(std::string_view bytes);
    /// The next complete message. Empty if more bytes are needed or after a fault. The bytes of a
    /// message above largest_message are dropped as they arrive.
    std::optional<Frame> next();
    /// The reason why no further message can be found in the stream. Empty if there is no fault.
    const std::string& fault() const { return fault_; }

private:
    bool read_header();

    std::string bytes_;
    std::size_t begin_ = 0;              ///< The bytes before this one have been used.
    std::optional<std::size_t> length_;  ///< How many bytes of the present message are missing.
    bool is_dropped_ = false;            ///< Whether the present message is too large.
    std::string fault_;
};

}  // namespace cascade::lsp
