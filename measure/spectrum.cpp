// FFTW transforms each axis, with a Fourier transform if it is periodic and a cosine transform
// otherwise. Power is summed over rings of wave numbers. The rings at the peak give the wavelength.
#include "measure/spectrum.h"

#include "core/late_library.h"
#include "core/transform_planner.h"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

namespace cascade::measure {

namespace {

/// The ratio of the wave number at the end of a peak to the wave number at its centre. It is less
/// than √2, the ratio for the second wave of a square lattice.
constexpr double peak_breadth = 1.3;

struct Fftw {
    LateLibrary library{CASCADE_FFTW_LIBRARY};
    decltype(&fftw_free) free = library["fftw_free"];
    decltype(&fftw_alloc_real) alloc_real = library["fftw_alloc_real"];
    decltype(&fftw_plan_r2r) plan_r2r = library["fftw_plan_r2r"];
    decltype(&fftw_execute) execute = library["fftw_execute"];
    decltype(&fftw_destroy_plan) destroy_plan = library["fftw_destroy_plan"];
};

const Fftw& fftw() {
    static const Fftw functions;
    return functions;
}

struct FreeBuffer {
    void operator()(double* buffer) const { fftw().free(buffer); }
};
using Buffer = std::unique_ptr<double[], FreeBuffer>;

/// The values minus their mean. Cells outside the domain get 0.
Buffer centred(const Samples& samples) {
    Buffer buffer(fftw().alloc_real(samples.count()));
    double sum = 0;
    std::size_t inside = 0;
    for (const double value : samples.values) {
        if (!std::isfinite(value)) continue;
        sum += value;
        ++inside;
    }
    const double mean = inside > 0 ? sum / static_cast<double>(inside) : 0;
    for (std::size_t cell = 0; cell < samples.count(); ++cell) {
        const double value = samples.values[cell];
        buffer[cell] = std::isfinite(value) ? value - mean : 0.0;
    }
    return buffer;
}

/// Transforms in place. FFTW expects the axes in the order from the slowest to the fastest. R2HC is
/// FFTW's real Fourier transform. Its result has cosine coefficients from the start of the array
/// on, and sine coefficients from the end backwards. REDFT10 is the DCT-II.
void transform(const Samples& samples, double* values) {
    int sizes[3];
    fftw_r2r_kind kinds[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        sizes[2 - axis] = static_cast<int>(samples.cells[axis]);
        kinds[2 - axis] = samples.periodic[axis] ? FFTW_R2HC : FFTW_REDFT10;
    }
    fftw_plan plan = nullptr;
    {
        const TransformPlanner planner;
        plan = fftw().plan_r2r(3, sizes, values, values, kinds, FFTW_ESTIMATE);
    }
    fftw().execute(plan);
    const TransformPlanner planner;
    fftw().destroy_plan(plan);
}

/// The wave number of every coefficient along one axis, and the coefficient's weight in Parseval's
/// sum.
struct AxisModes {
    std::vector<double> wave_number;
    std::vector<double> weight;
};

AxisModes modes_of(const Samples& samples, std::size_t axis) {
    const std::size_t count = samples.cells[axis];
    const auto cells = static_cast<double>(count);
    const double length = cells * samples.spacing[axis];
    AxisModes modes;
    for (std::size_t n = 0; n < count; ++n) {
        if (samples.periodic[axis]) {
            const std::size_t waves = std::min(n, count - n);
            // Whether the mode has no sine coefficient beside its cosine coefficient.
            const bool is_alone = waves == 0 || 2 * waves == count;
            modes.wave_number.push_back(static_cast<double>(waves) / length);
            modes.weight.push_back((is_alone ? 1 : 2) / cells);
        } else {
            modes.wave_number.push_back(static_cast<double>(n) / (2 * length));
            modes.weight.push_back((n == 0 ? 0.5 : 1) / (2 * cells));
        }
    }
    return modes;
}

double ring_width_of(const Samples& samples) {
    double finest = std::numeric_limits<double>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (samples.cells[axis] == 1) continue;
        const double length = static_cast<double>(samples.cells[axis]) * samples.spacing[axis];
        finest = std::min(finest, 1 / (samples.periodic[axis] ? length : 2 * length));
    }
    return std::isfinite(finest) ? finest : 1;
}

/// Sums over the rings that belong to the peak.
struct Peak {
    double power = 0;
    double moment = 0;
};

Peak peak_of(const Spectrum& spectrum) {
    Peak peak;
    if (spectrum.power.size() < 2) return peak;
    const auto strongest = std::max_element(spectrum.power.begin() + 1, spectrum.power.end());
    const auto middle = static_cast<double>(strongest - spectrum.power.begin());
    for (std::size_t ring = 1; ring < spectrum.power.size(); ++ring) {
        const auto n = static_cast<double>(ring);
        if (n < middle / peak_breadth || n > middle * peak_breadth) continue;
        peak.power += spectrum.power[ring];
        peak.moment += spectrum.moment[ring];
    }
    return peak;
}

}  // namespace

Spectrum radial_spectrum(const Samples& samples) {
    const Buffer values = centred(samples);
    transform(samples, values.get());
    const AxisModes modes[3] = {modes_of(samples, 0), modes_of(samples, 1), modes_of(samples, 2)};
    Spectrum spectrum;
    spectrum.ring_width = ring_width_of(samples);
    const auto count = static_cast<double>(samples.count());
    std::size_t cell = 0;
    for (std::size_t k = 0; k < samples.cells[2]; ++k) {
        for (std::size_t j = 0; j < samples.cells[1]; ++j) {
            for (std::size_t i = 0; i < samples.cells[0]; ++i, ++cell) {
                const double power = values[cell] * values[cell] * modes[0].weight[i] *
                                     modes[1].weight[j] * modes[2].weight[k] / count;
                const double magnitude =
                    std::hypot(modes[0].wave_number[i], modes[1].wave_number[j],
                               modes[2].wave_number[k]);
                const auto ring =
                    static_cast<std::size_t>(std::lround(magnitude / spectrum.ring_width));
                if (ring >= spectrum.power.size()) {
                    spectrum.power.resize(ring + 1);
                    spectrum.moment.resize(ring + 1);
                    spectrum.modes.resize(ring + 1);
                }
                ++spectrum.modes[ring];
                spectrum.power[ring] += power;
                spectrum.moment[ring] += power * magnitude;
            }
        }
    }
    return spectrum;
}

Spectrum in_wide_rings(const Spectrum& spectrum) {
    constexpr double rings_below = 12;
    if (spectrum.power.size() < 2) return spectrum;
    const auto strongest = std::max_element(spectrum.power.begin() + 1, spectrum.power.end());
    const auto middle = static_cast<double>(strongest - spectrum.power.begin());
    const double times = std::max(1.0, std::round(middle / rings_below));
    Spectrum wide;
    wide.ring_width = times * spectrum.ring_width;
    for (std::size_t ring = 0; ring < spectrum.power.size(); ++ring) {
        const auto to = static_cast<std::size_t>(std::lround(static_cast<double>(ring) / times));
        wide.power.resize(std::max(wide.power.size(), to + 1));
        wide.moment.resize(wide.power.size());
        wide.modes.resize(wide.power.size());
        wide.modes[to] += spectrum.modes[ring];
        wide.power[to] += spectrum.power[ring];
        wide.moment[to] += spectrum.moment[ring];
    }
    return wide;
}

double peak_wavelength(const Spectrum& spectrum) {
    const Peak peak = peak_of(spectrum);
    return peak.power > 0 ? peak.power / peak.moment : std::numeric_limits<double>::quiet_NaN();
}

double first_moment_length(const Spectrum& spectrum) {
    double sum = 0, moment = 0;
    for (std::size_t ring = 1; ring < spectrum.power.size(); ++ring) {
        if (!(spectrum.modes[ring] > 0)) continue;
        sum += spectrum.power[ring] / spectrum.modes[ring];
        moment += spectrum.moment[ring] / spectrum.modes[ring];
    }
    return moment > 0 ? sum / moment : std::numeric_limits<double>::quiet_NaN();
}

double peak_share(const Spectrum& spectrum) {
    const double whole = std::accumulate(spectrum.power.begin(), spectrum.power.end(), 0.0);
    return whole > 0 ? peak_of(spectrum).power / whole : 0;
}

}  // namespace cascade::measure
