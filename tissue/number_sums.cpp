// Sums in binary64.
#include "tissue/number_sums.h"

#include <algorithm>
#include <cmath>

namespace cascade {

std::vector<double> root_mean_squares(const std::vector<Field>& fields, const Tissue& tissue,
                                      Team& team, const std::vector<Field>* others) {
    std::vector<double> result(fields.size());
    const auto sum_of = [&]<typename Number>(const Plane<Number>& plane, const Number* other) {
        double sum = 0;
        for (const std::uint32_t at : tissue.elements_by_number()) {
            double value = plane.origin()[at];
            if (other != nullptr) value -= other[at];
            sum += value * value;
        }
        return sum;
    };
    team.run([&](int thread) {
        for (auto k = static_cast<std::size_t>(thread); k < fields.size();
             k += static_cast<std::size_t>(team.size())) {
            const double sum = fields[k].visit([&]<typename Number>(const Plane<Number>& plane) {
                return sum_of(plane, others == nullptr
                                         ? nullptr
                                         : (*others)[k].template plane<Number>().origin());
            });
            const auto cells = static_cast<double>(std::max<std::size_t>(1, tissue.count()));
            result[k] = std::sqrt(sum / cells);
        }
    });
    return result;
}

std::vector<double> sizes_of(const std::vector<Field>& species, const Tissue& tissue,
                             const TissueSpecies& roles, double mean_radius, Team& team) {
    std::vector<double> sizes = root_mean_squares(species, tissue, team);
    for (std::size_t k = 0; k < 3 && mean_radius > 0; ++k) {
        if (std::isfinite(sizes[roles.place + k])) sizes[roles.place + k] = mean_radius;
    }
    // The negation keeps NaN.
    for (double& size : sizes) size = size < 1e-30 ? 1e-30 : size;
    return sizes;
}

}  // namespace cascade
