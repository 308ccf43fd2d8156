// Filling the halo of planes.
#include "core/plane.h"

#include "core/check.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>

#include <sys/mman.h>

namespace cascade {
namespace {

constexpr std::size_t cache_line = 64;
constexpr std::size_t huge_page = std::size_t{2} << 20;

/// Where the ends of an axis of `count` cells see their cells beyond, as cells of the axis.
struct Ends {
    std::int64_t before;  ///< The cell that stands at −1.
    std::int64_t behind;  ///< The cell that stands at `count`.

    Ends(Boundary boundary, std::int64_t count)
        : before(boundary == Boundary::periodic ? count - 1 : 0), behind(count - 1 - before) {}
};

/// Fills the halo that comes from some rows of a slice.
class HaloFill {
public:
    HaloFill(float* origin, const PlaneLayout& layout, const Boundaries& boundary)
        : origin_(origin),
          layout_(layout),
          columns_(boundary.x, layout.width),
          rows_(boundary.y, layout.height),
          slices_(boundary.z, layout.depth) {}

    /// Every row of the halo is a copy of one row of cells, and it is filled along with that.
    void from_rows(std::int64_t slice, std::int64_t begin, std::int64_t end) const {
        for (std::int64_t j = begin; j < end; ++j) {
            float* cells = row(j, slice);
            cells[-1] = cells[columns_.before];
            cells[layout_.width] = cells[columns_.behind];
        }
        copy_outer_rows(slice, begin, end, slice);
        if (!layout_.has_halo_slices()) return;
        if (slice == slices_.before) copy_rows(slice, begin, end, -1);
        if (slice == slices_.behind) copy_rows(slice, begin, end, layout_.depth);
    }

private:
    float* row(std::int64_t row, std::int64_t slice) const {
        return origin_ + slice * layout_.slice_stride + row * layout_.stride;
    }

    /// With the halo columns.
    void copy_row(std::int64_t from, std::int64_t slice, std::int64_t to,
                  std::int64_t to_slice) const {
        std::memcpy(row(to, to_slice) - 1, row(from, slice) - 1,
                    static_cast<std::size_t>(layout_.width + 2) * sizeof(float));
    }

    /// The halo rows of `to_slice` that come from some rows of a slice.
    void copy_outer_rows(std::int64_t slice, std::int64_t begin, std::int64_t end,
                         std::int64_t to_slice) const {
        const auto is_given = [&](std::int64_t row) { return begin <= row && row < end; };
        if (is_given(rows_.before)) copy_row(rows_.before, slice, -1, to_slice);
        if (is_given(rows_.behind)) copy_row(rows_.behind, slice, layout_.height, to_slice);
    }

    void copy_rows(std::int64_t slice, std::int64_t begin, std::int64_t end,
                   std::int64_t to_slice) const {
        for (std::int64_t j = begin; j < end; ++j) copy_row(j, slice, j, to_slice);
        copy_outer_rows(slice, begin, end, to_slice);
    }

    float* origin_;
    const PlaneLayout& layout_;
    Ends columns_, rows_, slices_;
};

}  // namespace

void* allocate_plane(std::size_t bytes) {
    const bool is_large = bytes >= 2 * huge_page;
    const std::size_t alignment = is_large ? huge_page : cache_line;
    const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;
    void* plane = std::aligned_alloc(alignment, rounded);
    if (plane == nullptr) throw std::bad_alloc();
    // Advice only: without huge pages the plane is as good, but slower.
    if (is_large) madvise(plane, rounded, MADV_HUGEPAGE);
    std::memset(plane, 0, bytes);
    return plane;
}

void free_plane(void* plane) { std::free(plane); }

void fill_halo(float* origin, const PlaneLayout& layout, const Boundaries& boundary) {
    fill_halo_from_rows(origin, layout, boundary, 0, layout.row_count());
}

void fill_halo_from_rows(float* origin, const PlaneLayout& layout, const Boundaries& boundary,
                         std::int64_t begin, std::int64_t end) {
    CHECK(0 <= begin && end <= layout.row_count(), "a halo comes from rows of the plane");
    const HaloFill fill(origin, layout, boundary);
    while (begin < end) {
        const std::int64_t slice = begin / layout.height;
        const std::int64_t first = begin - slice * layout.height;
        const std::int64_t last = std::min(layout.height, first + end - begin);
        fill.from_rows(slice, first, last);
        begin += last - first;
    }
}

}  // namespace cascade
