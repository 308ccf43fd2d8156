// The part of FFTW's interface that Cascade uses, implemented by the Fourier transform of Eigen
// (kissfft), a header-only library. It is slower than FFTW, and its results differ only by
// rounding.
//
// FFTW's manual, section 4.8, defines the real transforms. Cosine transforms of types II and III
// use one complex transform of the same length (J. Makhoul, "A Fast Cosine Transform in One and Two
// Dimensions", 1980).
#include "core/check.h"
#include "core/late_library.h"

#include <fftw3.h>
#include <unsupported/Eigen/FFT>

#include <complex>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <string_view>
#include <vector>

namespace cascade {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

enum class Transform : std::uint8_t { real, forward, backward, to_half, from_half };

/// The layout of lines in memory: the number of elements from one number of a line to the next
/// (`stride`), and from one line to the next (`distance`).
struct Lines {
    int stride, distance;
};

/// Transforms lines of n numbers. In complex transforms, a number of a line is a pair: its real and
/// its imaginary part.
struct Pass {
    Transform transform;
    fftw_r2r_kind kind;  ///< The kind of a real transform.
    int n, count;
    Lines from, to;
};

struct Plan {
    Pass pass;
    // The sizes and kinds for fftw_plan_r2r(), which transforms along several axes. They begin with
    // the axis whose index varies slowest in memory.
    std::vector<int> sizes = {};
    std::vector<fftw_r2r_kind> kinds = {};
    double* values = nullptr;
};

Complex turned(double angle) { return std::polar(1.0, angle); }

/// The transform without normalisation.
std::vector<Complex> transformed(const std::vector<Complex>& from, bool is_backward) {
    static Eigen::FFT<double> fft(Eigen::FFT<double>::impl_type(), Eigen::FFT<double>::Unscaled);
    std::vector<Complex> to;
    if (from.size() == 1) return from;
    if (is_backward) fft.inv(to, from);
    else fft.fwd(to, from);
    return to;
}

std::vector<double> half_complex_of(const std::vector<double>& x) {
    const std::size_t n = x.size();
    const auto waves = transformed({x.begin(), x.end()}, false);
    std::vector<double> y(n);
    for (std::size_t k = 0; k <= n / 2; ++k) {
        y[k] = waves[k].real();
        if (k > 0 && k < n - k) y[n - k] = waves[k].imag();
    }
    return y;
}

std::vector<double> real_of_half_complex(const std::vector<double>& x) {
    const std::size_t n = x.size();
    std::vector<Complex> waves(n, x[0]);
    for (std::size_t k = 1; k <= n / 2; ++k) {
        waves[k] = Complex(x[k], k < n - k ? x[n - k] : 0);
        waves[n - k] = std::conj(waves[k]);
    }
    const auto values = transformed(waves, true);
    std::vector<double> y(n);
    for (std::size_t k = 0; k < n; ++k) y[k] = values[k].real();
    return y;
}

/// The index of number k after reordering: first the numbers with even k in ascending order, then
/// the numbers with odd k in descending order.
std::size_t folded(std::size_t k, std::size_t n) { return k % 2 == 0 ? k / 2 : n - 1 - k / 2; }

std::vector<double> cosine_2(const std::vector<double>& x) {
    const std::size_t n = x.size();
    std::vector<Complex> values(n);
    for (std::size_t k = 0; k < n; ++k) values[folded(k, n)] = x[k];
    const auto waves = transformed(values, false);
    std::vector<double> y(n);
    for (std::size_t k = 0; k < n; ++k) {
        const double part = static_cast<double>(k) / static_cast<double>(n);
        y[k] = 2 * (turned(-pi / 2 * part) * waves[k]).real();
    }
    return y;
}

std::vector<double> cosine_3(const std::vector<double>& x) {
    const std::size_t n = x.size();
    std::vector<Complex> waves(n);
    for (std::size_t k = 0; k < n; ++k) {
        const double part = static_cast<double>(k) / static_cast<double>(n);
        waves[k] = turned(pi / 2 * part) * Complex(x[k], k > 0 ? -x[n - k] : 0);
    }
    const auto values = transformed(waves, true);
    std::vector<double> y(n);
    for (std::size_t k = 0; k < n; ++k) y[k] = values[folded(k, n)].real();
    return y;
}

std::vector<double> cosine_4(const std::vector<double>& x) {
    const std::size_t n = x.size();
    const double step = pi / (2 * static_cast<double>(n));
    std::vector<Complex> values(2 * n);
    for (std::size_t k = 0; k < n; ++k) values[k] = x[k] * turned(-step * static_cast<double>(k));
    const auto waves = transformed(values, false);
    std::vector<double> y(n);
    for (std::size_t k = 0; k < n; ++k) {
        y[k] = 2 * (turned(-step * (static_cast<double>(k) + 0.5)) * waves[k]).real();
    }
    return y;
}

std::vector<double> real_transform(const std::vector<double>& x, fftw_r2r_kind kind) {
    switch (kind) {
        case FFTW_R2HC: return half_complex_of(x);
        case FFTW_HC2R: return real_of_half_complex(x);
        case FFTW_REDFT10: return cosine_2(x);
        case FFTW_REDFT01: return cosine_3(x);
        case FFTW_REDFT11: return cosine_4(x);
        default: CHECK(false, "a tab has the transforms that Cascade uses"); return {};
    }
}

template <typename Number>
void run_line(const Pass& pass, const Number* from, Number* to) {
    const auto n = static_cast<std::size_t>(pass.n);
    const auto real_in = [&](std::size_t k) { return double{from[k * pass.from.stride]}; };
    const auto complex_in = [&](std::size_t k) {
        const Number* const pair = from + k * pass.from.stride * 2;
        return Complex(pair[0], pair[1]);
    };
    const auto put_complex = [&](std::size_t k, Complex value) {
        Number* const pair = to + k * pass.to.stride * 2;
        pair[0] = static_cast<Number>(value.real());
        pair[1] = static_cast<Number>(value.imag());
    };
    const auto put_real = [&](std::size_t k, double value) {
        to[k * pass.to.stride] = static_cast<Number>(value);
    };
    if (pass.transform == Transform::real) {
        std::vector<double> x(n);
        for (std::size_t k = 0; k < n; ++k) x[k] = real_in(k);
        const auto y = real_transform(x, pass.kind);
        for (std::size_t k = 0; k < n; ++k) put_real(k, y[k]);
        return;
    }
    const bool is_back =
        pass.transform == Transform::backward || pass.transform == Transform::from_half;
    std::vector<Complex> x(n);
    for (std::size_t k = 0; k < n; ++k) {
        if (pass.transform == Transform::to_half) x[k] = real_in(k);
        else if (pass.transform != Transform::from_half) x[k] = complex_in(k);
        else x[k] = k <= n / 2 ? complex_in(k) : std::conj(complex_in(n - k));
    }
    const auto y = transformed(x, is_back);
    for (std::size_t k = 0; k < n; ++k) {
        if (pass.transform == Transform::from_half) put_real(k, y[k].real());
        else if (pass.transform != Transform::to_half || k <= n / 2) put_complex(k, y[k]);
    }
}

template <typename Number>
void run(const void* plan, const Number* from, Number* to) {
    const Pass& pass = static_cast<const Plan*>(plan)->pass;
    const bool from_pairs =
        pass.transform != Transform::real && pass.transform != Transform::to_half;
    const bool to_pairs =
        pass.transform != Transform::real && pass.transform != Transform::from_half;
    for (std::ptrdiff_t line = 0; line < pass.count; ++line) {
        run_line(pass, from + line * pass.from.distance * (from_pairs ? 2 : 1),
                 to + line * pass.to.distance * (to_pairs ? 2 : 1));
    }
}

// FFTW's functions. Plans of single and double precision are the same type.

void* plan_many(Pass pass) { return new Plan{pass}; }

template <typename Number>
void* plan_many_r2r(int, const int* n, int count, Number*, const int*, int from_stride,
                    int from_distance, Number*, const int*, int to_stride, int to_distance,
                    const fftw_r2r_kind* kind, unsigned) {
    return plan_many({Transform::real,
                      *kind,
                      *n,
                      count,
                      {from_stride, from_distance},
                      {to_stride, to_distance}});
}

template <typename Pair>
void* plan_many_dft(int, const int* n, int count, Pair*, const int*, int from_stride,
                    int from_distance, Pair*, const int*, int to_stride, int to_distance, int sign,
                    unsigned) {
    return plan_many({sign == FFTW_FORWARD ? Transform::forward : Transform::backward,
                      FFTW_R2HC,
                      *n,
                      count,
                      {from_stride, from_distance},
                      {to_stride, to_distance}});
}

template <typename Number, typename Pair>
void* plan_many_dft_r2c(int, const int* n, int count, Number*, const int*, int from_stride,
                        int from_distance, Pair*, const int*, int to_stride, int to_distance,
                        unsigned) {
    return plan_many({Transform::to_half,
                      FFTW_R2HC,
                      *n,
                      count,
                      {from_stride, from_distance},
                      {to_stride, to_distance}});
}

template <typename Number, typename Pair>
void* plan_many_dft_c2r(int, const int* n, int count, Pair*, const int*, int from_stride,
                        int from_distance, Number*, const int*, int to_stride, int to_distance,
                        unsigned) {
    return plan_many({Transform::from_half,
                      FFTW_R2HC,
                      *n,
                      count,
                      {from_stride, from_distance},
                      {to_stride, to_distance}});
}

void* plan_r2r(int rank, const int* sizes, double* values, double*, const fftw_r2r_kind* kinds,
               unsigned) {
    return new Plan{{}, {sizes, sizes + rank}, {kinds, kinds + rank}, values};
}

void execute(const void* made) {
    const Plan& plan = *static_cast<const Plan*>(made);
    int stride = 1;
    for (const int n : plan.sizes) stride *= n;
    const int all = stride;
    for (std::size_t axis = 0; axis < plan.sizes.size(); ++axis) {
        const int n = plan.sizes[axis];
        stride /= n;
        const Lines lines{stride, 1};
        const Pass pass{Transform::real, plan.kinds[axis], n, stride, lines, lines};
        for (int block = 0; block < all; block += n * stride) {
            for (int line = 0; line < stride; ++line) {
                double* const at = plan.values + block + line;
                run_line(pass, at, at);
            }
        }
    }
}

template <typename Number>
void execute_r2r(const void* plan, Number* from, Number* to) {
    run(plan, from, to);
}
template <typename Number, typename Pair>
void execute_dft(const void* plan, Pair* from, Pair* to) {
    run(plan, reinterpret_cast<Number*>(from), reinterpret_cast<Number*>(to));
}
template <typename Number, typename Pair>
void execute_dft_r2c(const void* plan, Number* from, Pair* to) {
    run(plan, from, reinterpret_cast<Number*>(to));
}
template <typename Number, typename Pair>
void execute_dft_c2r(const void* plan, Pair* from, Number* to) {
    run(plan, reinterpret_cast<Number*>(from), to);
}

void destroy_plan(void* plan) { delete static_cast<Plan*>(plan); }
double* alloc_real(std::size_t count) {
    return static_cast<double*>(std::malloc(count * sizeof(double)));
}

struct Entry {
    std::string_view name;
    void* address;
};

template <typename Function>
void* address_of(Function* function) {
    return reinterpret_cast<void*>(function);
}

const Entry entries[] = {
    {"fftw_alloc_real", address_of(alloc_real)},
    {"fftw_free", address_of(std::free)},
    {"fftw_plan_r2r", address_of(plan_r2r)},
    {"fftw_execute", address_of(execute)},
    {"fftw_destroy_plan", address_of(destroy_plan)},
    {"fftw_plan_many_r2r", address_of(plan_many_r2r<double>)},
    {"fftw_plan_many_dft", address_of(plan_many_dft<fftw_complex>)},
    {"fftw_plan_many_dft_r2c", address_of(plan_many_dft_r2c<double, fftw_complex>)},
    {"fftw_plan_many_dft_c2r", address_of(plan_many_dft_c2r<double, fftw_complex>)},
    {"fftw_execute_r2r", address_of(execute_r2r<double>)},
    {"fftw_execute_dft", address_of(execute_dft<double, fftw_complex>)},
    {"fftw_execute_dft_r2c", address_of(execute_dft_r2c<double, fftw_complex>)},
    {"fftw_execute_dft_c2r", address_of(execute_dft_c2r<double, fftw_complex>)},
    {"fftwf_destroy_plan", address_of(destroy_plan)},
    {"fftwf_plan_many_r2r", address_of(plan_many_r2r<float>)},
    {"fftwf_plan_many_dft", address_of(plan_many_dft<fftwf_complex>)},
    {"fftwf_plan_many_dft_r2c", address_of(plan_many_dft_r2c<float, fftwf_complex>)},
    {"fftwf_plan_many_dft_c2r", address_of(plan_many_dft_c2r<float, fftwf_complex>)},
    {"fftwf_execute_r2r", address_of(execute_r2r<float>)},
    {"fftwf_execute_dft", address_of(execute_dft<float, fftwf_complex>)},
    {"fftwf_execute_dft_r2c", address_of(execute_dft_r2c<float, fftwf_complex>)},
    {"fftwf_execute_dft_c2r", address_of(execute_dft_c2r<float, fftwf_complex>)},
};

}  // namespace

LateLibrary::LateLibrary(const char* file) : file_(file), handle_(nullptr) {}

LateFunction LateLibrary::operator[](const char* name) const {
    for (const Entry& entry : entries) {
        if (entry.name == name) return {entry.address};
    }
    CHECK(false, "a tab has the functions of FFTW that Cascade uses");
}

}  // namespace cascade
