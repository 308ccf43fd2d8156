// Filling the halo of planes.
#include "core/plane.h"

#include "core/check.h"

#include <cstdlib>
#include <cstring>
#include <new>

#include <sys/mman.h>

namespace cascade {
namespace {

constexpr std::size_t cache_line = 64;
constexpr std::size_t huge_page = std::size_t{2} << 20;

void copy_row(float* origin, const PlaneLayout& layout, std::int64_t from, std::int64_t to) {
    std::memcpy(origin + to * layout.stride, origin + from * layout.stride,
                static_cast<std::size_t>(layout.width) * sizeof(float));
}

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

void fill_halo(float* origin, const PlaneLayout& layout, Boundary boundary) {
    fill_halo_from_rows(origin, layout, boundary, 0, layout.height);
}

void fill_halo_from_rows(float* origin, const PlaneLayout& layout, Boundary boundary,
                         std::int64_t begin, std::int64_t end) {
    fill_halo_columns(origin, layout, boundary, begin, end);
    if (begin >= end) return;
    const bool periodic = boundary == Boundary::periodic;
    if (begin == 0) copy_row(origin, layout, 0, periodic ? layout.height : -1);
    if (end == layout.height) {
        copy_row(origin, layout, layout.height - 1, periodic ? -1 : layout.height);
    }
}

void fill_halo_columns(float* origin, const PlaneLayout& layout, Boundary boundary,
                       std::int64_t begin, std::int64_t end) {
    CHECK(0 <= begin && end <= layout.height, "halo columns belong to rows of the plane");
    const std::int64_t last = layout.width - 1;
    const std::int64_t west = boundary == Boundary::periodic ? last : 0;
    const std::int64_t east = last - west;
    for (std::int64_t j = begin; j < end; ++j) {
        float* row = origin + j * layout.stride;
        row[-1] = row[west];
        row[last + 1] = row[east];
    }
}

void fill_halo_rows(float* origin, const PlaneLayout& layout, Boundary boundary) {
    const bool periodic = boundary == Boundary::periodic;
    copy_row(origin, layout, 0, periodic ? layout.height : -1);
    copy_row(origin, layout, layout.height - 1, periodic ? -1 : layout.height);
}

}  // namespace cascade
