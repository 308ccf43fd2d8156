// See pattern_statistics.h.
#include "tests/oracle/pattern_statistics.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

namespace cascade {

namespace {

using Complex = std::complex<double>;

/// Computes the discrete Fourier transform, by its definition, of `count` values that are `stride`
/// apart.
void transform(std::vector<Complex>& values, std::size_t first, std::size_t count,
               std::size_t stride, const std::vector<Complex>& roots) {
    std::vector<Complex> result(count);
    for (std::size_t k = 0; k < count; ++k) {
        Complex sum = 0;
        for (std::size_t n = 0; n < count; ++n) {
            sum += values[first + n * stride] * roots[k * n % count];
        }
        result[k] = sum;
    }
    for (std::size_t k = 0; k < count; ++k) values[first + k * stride] = result[k];
}

std::vector<Complex> roots_of_unity(std::size_t count) {
    std::vector<Complex> roots(count);
    for (std::size_t k = 0; k < count; ++k) {
        const double turn = static_cast<double>(k) / static_cast<double>(count);
        roots[k] = std::polar(1.0, -2 * std::numbers::pi * turn);
    }
    return roots;
}

/// |DFT|² after subtraction of the mean.
std::vector<double> power_spectrum(const Pattern2d& pattern) {
    const double mean = moments(pattern).mean;
    std::vector<Complex> values;
    for (const double value : pattern.values) values.emplace_back(value - mean);
    const auto row_roots = roots_of_unity(pattern.width);
    const auto column_roots = roots_of_unity(pattern.height);
    for (std::size_t j = 0; j < pattern.height; ++j) {
        transform(values, j * pattern.width, pattern.width, 1, row_roots);
    }
    for (std::size_t i = 0; i < pattern.width && pattern.height > 1; ++i) {
        transform(values, i, pattern.height, pattern.width, column_roots);
    }
    std::vector<double> power;
    for (const Complex& value : values) power.push_back(std::norm(value));
    return power;
}

/// The wave number of a DFT's bin, with its sign.
double signed_wave_number(std::size_t bin, std::size_t count) {
    const double k = static_cast<double>(bin);
    return 2 * bin > count ? k - static_cast<double>(count) : k;
}

/// The power-weighted mean of the wave numbers in the rings from `low` to `high`.
double mean_wave_number(const std::vector<double>& power, const std::vector<double>& moment,
                        double low, double high) {
    double powers = 0, moments_sum = 0;
    for (std::size_t ring = 1; ring < power.size(); ++ring) {
        const double k = static_cast<double>(ring);
        if (k < low || k > high) continue;
        powers += power[ring];
        moments_sum += moment[ring];
    }
    return moments_sum / powers;
}

}  // namespace

double area_fraction(const Pattern2d& pattern, const Predicate& predicate) {
    const auto count = std::count_if(pattern.values.begin(), pattern.values.end(), predicate);
    return static_cast<double>(count) / static_cast<double>(pattern.values.size());
}

std::size_t count_regions(const Pattern2d& pattern, const Predicate& predicate,
                          std::size_t smallest) {
    const std::size_t width = pattern.width, height = pattern.height;
    std::vector<bool> wanted;
    for (const double value : pattern.values) wanted.push_back(predicate(value));
    std::size_t regions = 0;
    for (std::size_t start = 0; start < wanted.size(); ++start) {
        if (!wanted[start]) continue;
        std::vector<std::size_t> region{start};
        wanted[start] = false;
        for (std::size_t next = 0; next < region.size(); ++next) {
            const std::size_t i = region[next] % width, j = region[next] / width;
            for (const std::size_t cell :
                 {j * width + (i + 1) % width, j * width + (i + width - 1) % width,
                  (j + 1) % height * width + i, (j + height - 1) % height * width + i}) {
                if (wanted[cell]) region.push_back(cell);
                wanted[cell] = false;
            }
        }
        regions += region.size() >= smallest ? 1 : 0;
    }
    return regions;
}

Moments moments(const Pattern2d& pattern) {
    const auto count = static_cast<double>(pattern.values.size());
    Moments result;
    result.mean = std::accumulate(pattern.values.begin(), pattern.values.end(), 0.0) / count;
    double squares = 0;
    for (const double value : pattern.values) squares += std::pow(value - result.mean, 2);
    result.deviation = std::sqrt(squares / count);
    return result;
}

double correlation(const Pattern2d& a, const Pattern2d& b) {
    const Moments of_a = moments(a), of_b = moments(b);
    double products = 0;
    for (std::size_t cell = 0; cell < a.values.size(); ++cell) {
        products += (a.values[cell] - of_a.mean) * (b.values[cell] - of_b.mean);
    }
    return products / (static_cast<double>(a.values.size()) * of_a.deviation * of_b.deviation);
}

SpectrumSummary summarise_spectrum(const Pattern2d& pattern) {
    const std::vector<double> power = power_spectrum(pattern);
    std::vector<double> ring_power(pattern.width + 1), ring_moment(pattern.width + 1);
    Complex direction = 0;
    double total = 0;
    for (std::size_t bin = 1; bin < power.size(); ++bin) {
        const Complex k(signed_wave_number(bin % pattern.width, pattern.width),
                        signed_wave_number(bin / pattern.width, pattern.height));
        const double magnitude = std::abs(k);
        const auto ring = static_cast<std::size_t>(std::lround(magnitude));
        ring_power[ring] += power[bin];
        ring_moment[ring] += power[bin] * magnitude;
        direction += power[bin] * k * k / std::norm(k);
        total += power[bin];
    }
    const auto strongest = std::max_element(ring_power.begin(), ring_power.end());
    const auto peak = static_cast<double>(strongest - ring_power.begin());
    const auto width = static_cast<double>(pattern.width);
    SpectrumSummary summary;
    summary.peak_wavelength =
        width / mean_wave_number(ring_power, ring_moment, 0.5 * peak, 1.5 * peak);
    summary.mean_wavelength = width / mean_wave_number(ring_power, ring_moment, 1, width);
    summary.anisotropy = std::abs(direction) / total;
    return summary;
}

}  // namespace cascade
