// Decompresses lz-string: LZ78 with codes of growing width, six bits to a letter.
#include "import/lz_string.h"

#include <cstdint>
#include <vector>

namespace cascade::importing {

namespace {

class LzBits {
public:
    explicit LzBits(std::string_view letters) : letters_(letters) {}

    /// Reads a number of `count` bits, the lowest first. Empty if there are not enough letters.
    std::optional<std::uint32_t> take(int count) {
        std::uint32_t value = 0;
        for (int k = 0; k < count; ++k) {
            if (at_ / 6 >= letters_.size()) return std::nullopt;
            const int letter = value_of(letters_[at_ / 6]);
            if (letter < 0) return std::nullopt;
            value |= static_cast<std::uint32_t>(letter >> (5 - at_ % 6) & 1) << k;
            ++at_;
        }
        return value;
    }

private:
    static int value_of(char letter) {
        constexpr std::string_view alphabet =
            "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+-$";
        const std::size_t place = alphabet.find(letter);
        // '$' fills up the last group of letters. lz-string gives it the value 64, whose low six
        // bits are 0.
        return place == std::string_view::npos ? -1 : static_cast<int>(place & 63);
    }

    std::string_view letters_;
    std::size_t at_ = 0;
};

using Units = std::vector<std::uint32_t>;

std::string utf8_of(const Units& units) {
    std::string text;
    for (std::size_t k = 0; k < units.size(); ++k) {
        std::uint32_t code = units[k];
        const bool is_pair = code >= 0xd800 && code < 0xdc00 && k + 1 < units.size() &&
                             units[k + 1] >= 0xdc00 && units[k + 1] < 0xe000;
        if (is_pair) code = 0x10000 + ((code - 0xd800) << 10) + (units[++k] - 0xdc00);
        const auto add = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
        if (code < 0x80) {
            add(code);
        } else if (code < 0x800) {
            add(0xc0 | code >> 6);
            add(0x80 | (code & 63));
        } else if (code < 0x10000) {
            add(0xe0 | code >> 12);
            add(0x80 | (code >> 6 & 63));
            add(0x80 | (code & 63));
        } else {
            add(0xf0 | code >> 18);
            add(0x80 | (code >> 12 & 63));
            add(0x80 | (code >> 6 & 63));
            add(0x80 | (code & 63));
        }
    }
    return text;
}

/// An entry of the dictionary: an earlier entry and one more unit.
struct LzEntry {
    std::uint32_t before = 0;
    std::uint32_t last = 0;
    std::uint32_t size = 1;
};

/// The units of an entry, from first to last.
Units units_of(const std::vector<LzEntry>& entries, std::uint32_t index) {
    Units units(entries[index].size);
    for (std::size_t k = units.size(); k-- > 0; index = entries[index].before) {
        units[k] = entries[index].last;
    }
    return units;
}

}  // namespace

std::optional<std::string> from_lz_string(std::string_view letters, std::size_t most) {
    LzBits bits(letters);
    std::vector<LzEntry> entries(3);  // The codes 0, 1 and 2 have other meanings.
    std::uint32_t room = 4;           // The number of further codes that have the present width.
    int width = 3;
    const auto counts_down = [&] {
        if (--room == 0) room = 1u << width++;
    };
    /// The entry that a code denotes, or a new entry of one unit. The code 2 marks the end.
    const auto entry_of = [&](std::uint32_t code) -> std::optional<std::uint32_t> {
        if (code >= 2) return code;
        const auto unit = bits.take(code == 0 ? 8 : 16);
        if (!unit) return std::nullopt;
        entries.push_back({0, *unit, 1});
        return static_cast<std::uint32_t>(entries.size() - 1);
    };

    const auto first_code = bits.take(2);
    const auto first = first_code ? entry_of(*first_code) : std::nullopt;
    if (!first) return std::nullopt;
    if (*first == 2) return std::string();
    std::uint32_t before = *first;
    Units text = {entries[before].last};
    for (;;) {
        const auto code = bits.take(width);
        if (!code) return std::nullopt;
        if (*code == 2) return utf8_of(text);
        const auto entry = entry_of(*code);
        if (!entry) return std::nullopt;
        if (*code < 2) counts_down();
        const auto next = static_cast<std::uint32_t>(entries.size());
        if (*entry > next) return std::nullopt;
        // A code may denote the entry that is about to be made. This entry is the previous one,
        // followed by that one's first unit.
        Units units = units_of(entries, *entry < next ? *entry : before);
        if (*entry == next) units.push_back(units.front());
        text.insert(text.end(), units.begin(), units.end());
        if (text.size() > most) return std::nullopt;
        entries.push_back({before, units.front(), entries[before].size + 1});
        before = *entry;
        counts_down();
    }
}

}  // namespace cascade::importing
