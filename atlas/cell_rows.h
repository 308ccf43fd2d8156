// Which cells of a grid are taken, and where a shape has room (internal to atlas/).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace cascade {

/// Cells first … end − 1 of a row.
struct CellSpan {
    int row = 0, first = 0, end = 0;
};

/// A set of cells within width × height.
struct CellShape {
    int width = 0, height = 0;
    std::vector<CellSpan> spans;
};

struct CellPlace {
    int x = 0, y = 0;
};

class CellRows {
public:
    /// A square of free cells.
    explicit CellRows(int side);

    /// The place for a shape with the smallest y, and of these the smallest x, whose upper end,
    /// y + height, is below `limit`, and y at least `lowest`: one where none of its cells is taken.
    std::optional<CellPlace> find_room(const CellShape& shape, int lowest, int limit) const;

    /// Takes the cells of a shape and the eight around each of them.
    void take(const CellShape& shape, CellPlace place);

private:
    using Word = std::uint64_t;
    static constexpr int bits = 64;
    const Word* row(int y) const { return words_.data() + static_cast<std::size_t>(y * stride_); }
    void mark_blocked(const CellSpan& span, int y, std::vector<Word>& blocked,
                      std::vector<Word>& some) const;

    int side_, stride_;        ///< Cells, words.
    std::vector<Word> words_;  ///< A bit for each cell: 1 if it is taken. One more word in a row.
};

}  // namespace cascade
