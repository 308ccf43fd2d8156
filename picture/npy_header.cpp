// Parses the headers of .npy files, which are Python literals.
#include "picture/npy_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace cascade {
namespace {

constexpr std::string_view magic("\x93NUMPY", 6);
constexpr std::size_t longest_header = 1 << 16;  // NumPy itself writes about 120 bytes.

/// Parses the dictionary from left to right. If the text is not as expected, member functions
/// return false or nullopt, and the position is undefined.
class DictionaryReader {
public:
    explicit DictionaryReader(std::string_view text) : text_(text) {}

    bool read(NpyHeader& header);

private:
    void skip_blanks();
    bool take(char wanted);
    bool take_word(std::string_view word);
    std::optional<std::string_view> quoted();
    std::optional<std::uint64_t> integer();
    bool entry(NpyHeader& header, std::string_view key);
    bool type(NpyHeader& header);
    bool skip_list();
    bool order(NpyHeader& header);
    bool shape(NpyHeader& header);

    std::string_view text_;
    std::size_t position_ = 0;
    bool has_type_ = false;
    bool has_order_ = false;
    bool has_shape_ = false;
};

void DictionaryReader::skip_blanks() {
    position_ = std::min(text_.find_first_not_of(" \t\r\n", position_), text_.size());
}

bool DictionaryReader::take(char wanted) {
    skip_blanks();
    if (position_ == text_.size() || text_[position_] != wanted) return false;
    ++position_;
    return true;
}

bool DictionaryReader::take_word(std::string_view word) {
    skip_blanks();
    if (!text_.substr(position_).starts_with(word)) return false;
    position_ += word.size();
    return true;
}

std::optional<std::string_view> DictionaryReader::quoted() {
    skip_blanks();
    if (position_ == text_.size()) return std::nullopt;
    const char quote = text_[position_];
    if (quote != '\'' && quote != '"') return std::nullopt;
    const std::size_t end = text_.find(quote, position_ + 1);
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view inside = text_.substr(position_ + 1, end - position_ - 1);
    position_ = end + 1;
    return inside;
}

std::optional<std::uint64_t> DictionaryReader::integer() {
    skip_blanks();
    constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
    const std::size_t begin = position_;
    std::uint64_t value = 0;
    for (; position_ < text_.size(); ++position_) {
        const char digit = text_[position_];
        if (digit < '0' || digit > '9') break;
        const auto amount = static_cast<std::uint64_t>(digit - '0');
        if (value > (most - amount) / 10) return std::nullopt;
        value = value * 10 + amount;
    }
    if (position_ == begin) return std::nullopt;
    // Python 2 wrote long integers with an L, as in 64L.
    if (position_ < text_.size() && text_[position_] == 'L') ++position_;
    return value;
}

bool DictionaryReader::type(NpyHeader& header) {
    if (has_type_) return false;
    has_type_ = true;
    if (const auto text = quoted()) {
        header.type = *text;
        return true;
    }
    return skip_list();
}

/// Skips the list that describes a structured type. Does not check that each bracket is closed by
/// one of the same kind.
bool DictionaryReader::skip_list() {
    skip_blanks();
    if (position_ == text_.size() || text_[position_] != '[') return false;
    int depth = 0;
    while (position_ < text_.size()) {
        const char c = text_[position_];
        if (c == '\'' || c == '"') {
            if (!quoted()) return false;
            continue;
        }
        ++position_;
        if (c == '[' || c == '(') ++depth;
        if (c == ']' || c == ')') --depth;
        if (depth == 0) return true;
    }
    return false;
}

bool DictionaryReader::order(NpyHeader& header) {
    if (has_order_) return false;
    has_order_ = true;
    header.fortran_order = take_word("True");
    return header.fortran_order || take_word("False");
}

bool DictionaryReader::shape(NpyHeader& header) {
    if (has_shape_ || !take('(')) return false;
    has_shape_ = true;
    if (take(')')) return true;
    while (true) {
        const auto size = integer();
        if (!size) return false;
        header.shape.push_back(*size);
        const bool comma = take(',');
        if (take(')')) return comma || header.shape.size() > 1;  // In Python, (3) is not a tuple.
        if (!comma) return false;
    }
}

bool DictionaryReader::entry(NpyHeader& header, std::string_view key) {
    if (!take(':')) return false;
    if (key == "descr") return type(header);
    if (key == "fortran_order") return order(header);
    return key == "shape" && shape(header);
}

bool DictionaryReader::read(NpyHeader& header) {
    if (!take('{')) return false;
    while (!take('}')) {
        const auto key = quoted();
        if (!key || !entry(header, *key)) return false;
        if (take(',')) continue;
        if (!take('}')) return false;
        break;
    }
    skip_blanks();
    return position_ == text_.size() && has_type_ && has_order_ && has_shape_;
}

/// Reads a little-endian number of `count` bytes.
std::size_t unsigned_at(std::string_view bytes, std::size_t begin, std::size_t count) {
    std::size_t value = 0;
    for (std::size_t i = count; i-- > 0;) {
        value = value << 8 | static_cast<unsigned char>(bytes[begin + i]);
    }
    return value;
}

}  // namespace

Result<NpyHeader> parse_npy_header(std::string_view bytes) {
    if (!bytes.starts_with(magic)) return failure("it is not a .npy file");
    if (bytes.size() < magic.size() + 2) return failure("it ends within the header");
    const auto version = static_cast<unsigned char>(bytes[magic.size()]);
    const auto minor = static_cast<unsigned char>(bytes[magic.size() + 1]);
    if (version < 1 || version > 3 || minor != 0) {
        return failure(fmt::format("its format version {}.{} is not known", version, minor),
                       "versions 1.0, 2.0 and 3.0 can be read");
    }
    const std::size_t size_begin = magic.size() + 2;
    const std::size_t size_bytes = version == 1 ? 2 : 4;
    const std::size_t text_begin = size_begin + size_bytes;
    if (bytes.size() < text_begin) return failure("it ends within the header");
    const std::size_t text_size = unsigned_at(bytes, size_begin, size_bytes);
    if (text_size > longest_header) {
        return failure(fmt::format("its header of {} bytes is too long", text_size));
    }
    if (bytes.size() - text_begin < text_size) return failure("it ends within the header");
    NpyHeader header;
    header.data_begin = text_begin + text_size;
    if (!DictionaryReader(bytes.substr(text_begin, text_size)).read(header)) {
        return failure("its header is malformed",
                       "a header names descr, fortran_order and shape, each once");
    }
    return header;
}

}  // namespace cascade
