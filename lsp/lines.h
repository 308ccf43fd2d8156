// Lines and columns of a text, as editors count them, and its bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace cascade::lsp {

/// The unit in which columns are counted. UTF-16 unless the editor offers UTF-8.
enum class ColumnUnit : std::uint8_t { utf16, utf8 };

/// Both numbers count from 0.
struct Position {
    std::size_t line = 0, column = 0;
    friend auto operator<=>(const Position&, const Position&) = default;
};

/// The lines of a text, which end with LF, CR LF or CR. The text is not stored, so each call takes
/// it again.
class Lines {
public:
    Lines(std::string_view text, ColumnUnit unit);

    /// The position of a byte. A byte within a character counts as the start of the character.
    Position position_of(std::string_view text, std::size_t byte) const;
    /// The byte at a position. A column after the end of the line means the end of the line, and a
    /// line after the last line means the end of the text.
    std::size_t byte_at(std::string_view text, Position position) const;

private:
    /// A position in the text whose line, column and byte are known. There is a mark at the start
    /// of each line and, in long lines, about one in each kilobyte, so that no search reads a long
    /// text.
    struct Mark {
        std::uint32_t byte, line, column;
    };
    ColumnUnit unit_;
    std::vector<Mark> marks_;
};

}  // namespace cascade::lsp
