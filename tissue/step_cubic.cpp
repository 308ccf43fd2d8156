// The weights of values and rates are the same for all cells.
#include "tissue/step_cubic.h"

namespace cascade {
namespace {

struct Weights {
    Weights(double part, double step)
        : of_old((1 + 2 * part) * (1 - part) * (1 - part)),
          of_new(part * part * (3 - 2 * part)),
          of_old_rate(step * part * (1 - part) * (1 - part)),
          of_new_rate(-step * part * part * (1 - part)) {}

    template <typename Number>
    Number sum(const StepCubic& cubic, std::size_t species, std::int64_t at) const {
        const auto in = [&](const std::vector<Field>& state) {
            return state[species].template origin<Number>()[at];
        };
        return static_cast<Number>(
            of_old * in(cubic.old_state) + of_new * in(cubic.new_state) +
            (of_old_rate * in(cubic.old_rates) + of_new_rate * in(cubic.new_rates)));
    }

    double of_old, of_new, of_old_rate, of_new_rate;
};

}  // namespace

StepMoment StepCubic::moment_after(double part) const {
    StepMoment after = moment;
    after.t += part * moment.length;
    return after;
}

std::vector<double> StepCubic::values(std::int64_t element, double part) const {
    const Weights weights(part, moment.length);
    std::vector<double> result;
    for (std::size_t k = 0; k < new_state.size(); ++k) {
        new_state[k].visit([&]<typename Number>(const Plane<Number>&) {
            result.push_back(double{weights.sum<Number>(*this, k, element)});
        });
    }
    return result;
}

void StepCubic::put(std::vector<Field>& state, std::int64_t element, double part) const {
    const Weights weights(part, moment.length);
    for (std::size_t k = 0; k < state.size(); ++k) {
        state[k].visit([&]<typename Number>(Plane<Number>& plane) {
            plane.origin()[element] = weights.sum<Number>(*this, k, element);
        });
    }
}

void StepCubic::put_all(std::vector<Field>& state, double part) const {
    const Weights weights(part, moment.length);
    for (std::size_t k = 0; k < state.size(); ++k) {
        state[k].visit([&]<typename Number>(Plane<Number>& plane) {
            const PlaneLayout& layout = plane.layout();
            for (std::int64_t row = 0; row < layout.row_count(); ++row) {
                const std::int64_t first = layout.row_start(row);
                for (std::int64_t at = first; at < first + layout.width; ++at) {
                    plane.origin()[at] = weights.sum<Number>(*this, k, at);
                }
            }
        });
    }
}

}  // namespace cascade
