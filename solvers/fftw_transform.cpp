// FFTW's functions are looked up by name in the library for the precision at first use.
#include "solvers/fftw_transform.h"

#include "core/check.h"
#include "core/late_library.h"
#include "core/transform_planner.h"

#include <utility>

namespace cascade {
namespace {

/// FFTW's functions in both precisions.
template <typename Number>
struct Fftw;
template <>
struct Fftw<float> {
    using Complex = fftwf_complex;
    LateLibrary library{CASCADE_FFTW_FLOAT_LIBRARY};
    decltype(&fftwf_plan_many_r2r) plan_real = library["fftwf_plan_many_r2r"];
    decltype(&fftwf_plan_many_dft) plan_complex = library["fftwf_plan_many_dft"];
    decltype(&fftwf_plan_many_dft_r2c) plan_there = library["fftwf_plan_many_dft_r2c"];
    decltype(&fftwf_plan_many_dft_c2r) plan_back = library["fftwf_plan_many_dft_c2r"];
    decltype(&fftwf_execute_r2r) run_real = library["fftwf_execute_r2r"];
    decltype(&fftwf_execute_dft) run_complex = library["fftwf_execute_dft"];
    decltype(&fftwf_execute_dft_r2c) run_there = library["fftwf_execute_dft_r2c"];
    decltype(&fftwf_execute_dft_c2r) run_back = library["fftwf_execute_dft_c2r"];
    decltype(&fftwf_destroy_plan) destroy = library["fftwf_destroy_plan"];
};
template <>
struct Fftw<double> {
    using Complex = fftw_complex;
    LateLibrary library{CASCADE_FFTW_LIBRARY};
    decltype(&fftw_plan_many_r2r) plan_real = library["fftw_plan_many_r2r"];
    decltype(&fftw_plan_many_dft) plan_complex = library["fftw_plan_many_dft"];
    decltype(&fftw_plan_many_dft_r2c) plan_there = library["fftw_plan_many_dft_r2c"];
    decltype(&fftw_plan_many_dft_c2r) plan_back = library["fftw_plan_many_dft_c2r"];
    decltype(&fftw_execute_r2r) run_real = library["fftw_execute_r2r"];
    decltype(&fftw_execute_dft) run_complex = library["fftw_execute_dft"];
    decltype(&fftw_execute_dft_r2c) run_there = library["fftw_execute_dft_r2c"];
    decltype(&fftw_execute_dft_c2r) run_back = library["fftw_execute_dft_c2r"];
    decltype(&fftw_destroy_plan) destroy = library["fftw_destroy_plan"];
};

template <typename Number>
const Fftw<Number>& fftw() {
    static const Fftw<Number> functions;
    return functions;
}

template <typename Number>
auto* as_complex(Number* at) {
    return reinterpret_cast<typename Fftw<Number>::Complex*>(at);
}

}  // namespace

template <typename Number>
FftwTransform<Number>::FftwTransform(Kind kind, int direction, std::int64_t cells,
                                     std::int64_t count, const Lines& from, const Lines& to)
    : kind_(kind) {
    const int n = static_cast<int>(cells), many = static_cast<int>(count);
    const auto step = [](std::int64_t elements) { return static_cast<int>(elements); };
    const auto half = [](std::int64_t elements) { return static_cast<int>(elements / 2); };
    const auto r2r_kind = static_cast<fftw_r2r_kind>(direction);
    const Fftw<Number>& all = fftw<Number>();
    const TransformPlanner planner;
    switch (kind) {
        case real:
            plan_ = all.plan_real(1, &n, many, from.at, nullptr, step(from.stride),
                                  step(from.distance), to.at, nullptr, step(to.stride),
                                  step(to.distance), &r2r_kind, FFTW_ESTIMATE);
            break;
        case complex:
            plan_ = all.plan_complex(1, &n, many, as_complex(from.at), nullptr, half(from.stride),
                                     half(from.distance), as_complex(to.at), nullptr,
                                     half(to.stride), half(to.distance), direction, FFTW_ESTIMATE);
            break;
        case there:
            plan_ = all.plan_there(1, &n, 1, from.at, nullptr, 1, 0, as_complex(to.at), nullptr, 1,
                                   0, FFTW_ESTIMATE);
            break;
        case back:
            plan_ = all.plan_back(1, &n, 1, as_complex(from.at), nullptr, 1, 0, to.at, nullptr, 1,
                                  0, FFTW_ESTIMATE);
            break;
    }
    CHECK(plan_ != nullptr, "FFTW has a plan for every size");
}

template <typename Number>
FftwTransform<Number>::FftwTransform(FftwTransform&& other) noexcept
    : kind_(other.kind_), plan_(std::exchange(other.plan_, nullptr)) {}

template <typename Number>
FftwTransform<Number>& FftwTransform<Number>::operator=(FftwTransform&& other) noexcept {
    std::swap(kind_, other.kind_);
    std::swap(plan_, other.plan_);
    return *this;
}

template <typename Number>
FftwTransform<Number>::~FftwTransform() {
    if (plan_ == nullptr) return;
    const TransformPlanner planner;
    fftw<Number>().destroy(plan_);
}

template <typename Number>
void FftwTransform<Number>::run(Number* from, Number* to) const {
    const Fftw<Number>& all = fftw<Number>();
    switch (kind_) {
        case real: return all.run_real(plan_, from, to);
        case complex: return all.run_complex(plan_, as_complex(from), as_complex(to));
        case there: return all.run_there(plan_, from, as_complex(to));
        case back: return all.run_back(plan_, as_complex(from), to);
    }
}

template class FftwTransform<float>;
template class FftwTransform<double>;

}  // namespace cascade
