// FFTW's functions are looked up by name at first use, in FFTW's library for the precision in use.
#include "solvers/fftw_transform.h"

#include "core/check.h"
#include "core/late_library.h"
#include "core/transform_planner.h"

#include <utility>

namespace cascade {
namespace {

/// FFTW's functions for a precision.
template <typename Number>
struct Fftw;
#define CASCADE_FFTW(Number, prefix, file)                                                        \
    template <>                                                                                   \
    struct Fftw<Number> {                                                                         \
        using Complex = prefix##_complex;                                                         \
        LateLibrary library{file};                                                                \
        decltype(&prefix##_plan_many_r2r) plan_real = library[#prefix "_plan_many_r2r"];          \
        decltype(&prefix##_plan_many_dft) plan_complex = library[#prefix "_plan_many_dft"];       \
        decltype(&prefix##_plan_many_dft_r2c) plan_there = library[#prefix "_plan_many_dft_r2c"]; \
        decltype(&prefix##_plan_many_dft_c2r) plan_back = library[#prefix "_plan_many_dft_c2r"];  \
        decltype(&prefix##_execute_r2r) run_real = library[#prefix "_execute_r2r"];               \
        decltype(&prefix##_execute_dft) run_complex = library[#prefix "_execute_dft"];            \
        decltype(&prefix##_execute_dft_r2c) run_there = library[#prefix "_execute_dft_r2c"];      \
        decltype(&prefix##_execute_dft_c2r) run_back = library[#prefix "_execute_dft_c2r"];       \
        decltype(&prefix##_destroy_plan) destroy = library[#prefix "_destroy_plan"];              \
    }
CASCADE_FFTW(float, fftwf, CASCADE_FFTW_FLOAT_LIBRARY);
CASCADE_FFTW(double, fftw, CASCADE_FFTW_LIBRARY);
#undef CASCADE_FFTW

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
