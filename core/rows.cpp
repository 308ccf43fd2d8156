// Splits rows into nearly equal parts.
#include "core/rows.h"

#include "core/check.h"

#include <algorithm>

namespace cascade {

RowRange split_rows(std::int64_t rows, int index, int count) {
    CHECK(rows >= 0 && 0 <= index && index < count, "a part of the rows that exists");
    const std::int64_t each = rows / count;
    const std::int64_t rest = rows % count;  // The first `rest` parts have one row more.
    const std::int64_t begin = index * each + std::min<std::int64_t>(index, rest);
    return {begin, begin + each + (index < rest ? 1 : 0)};
}

}  // namespace cascade
