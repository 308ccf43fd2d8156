// Dynamic programming over intervals of the ring: the best triangulation of an interval consists of
// a triangle and the best triangulations of the two intervals beside it (G. T. Klincsek, "Minimal
// triangulations of polygonal domains", 1980).
#include "surface/fill_hole.h"

#include <algorithm>
#include <limits>

namespace cascade {

namespace {

/// The best triangulation of the ring's points from one point to another.
struct Part {
    double worst = std::numeric_limits<double>::infinity();  ///< The score of the worst triangle.
    /// The third corner of the triangle whose side joins the two points.
    std::uint32_t middle = 0;
};

class BestFilling {
public:
    BestFilling(std::uint32_t count, const Worth& worth) : count_(count), parts_(count * count) {
        for (std::uint32_t reach = 2; reach < count; ++reach) {
            for (std::uint32_t from = 0; from + reach < count; ++from) {
                part(from, from + reach) = best(from, from + reach, worth);
            }
        }
    }

    std::vector<RingTriangle> triangles() {
        std::vector<RingTriangle> found;
        if (part(0, count_ - 1).worst > 0) collect(0, count_ - 1, found);
        return found;
    }

private:
    Part& part(std::uint32_t from, std::uint32_t to) { return parts_[from * count_ + to]; }

    Part best(std::uint32_t from, std::uint32_t to, const Worth& worth) {
        Part best{0, 0};
        for (std::uint32_t middle = from + 1; middle < to; ++middle) {
            const double sides = std::min(part(from, middle).worst, part(middle, to).worst);
            if (sides <= best.worst) continue;
            const double worst = std::min(sides, worth({from, middle, to}));
            if (worst > best.worst) best = {worst, middle};
        }
        return best;
    }

    /// Appends the triangles of an interval: first the triangles of its two parts, then the
    /// triangle between these parts. So each triangle, when its turn comes, cuts its middle corner
    /// off the rest of the ring. The recursion is at most as deep as the ring is long.
    void collect(std::uint32_t from, std::uint32_t to, std::vector<RingTriangle>& found) {
        if (to - from < 2) return;
        const std::uint32_t middle = part(from, to).middle;
        collect(from, middle, found);
        collect(middle, to, found);
        found.push_back({from, middle, to});
    }

    std::uint32_t count_;
    std::vector<Part> parts_;
};

}  // namespace

std::vector<RingTriangle> best_triangles(std::uint32_t count, const Worth& worth) {
    if (count < 3) return {};
    return BestFilling(count, worth).triangles();
}

}  // namespace cascade
