// Transforms lines of numbers by FFTW (internal to solvers/). The first object loads FFTW.
#pragma once

#include <fftw3.h>

#include <cstdint>
#include <type_traits>

namespace cascade {

/// A transform of lines by a plan that FFTW estimates. FFTW could also measure, but would then
/// choose different plans in different runs. The memory given to run() must have the same alignment
/// as the memory given to the constructor.
template <typename Number>
class FftwTransform {
public:
    /// The layout of lines: the number of elements from one number of a line to the next, and from
    /// one line to the next.
    struct Lines {
        Number* at;
        std::int64_t stride, distance;
    };
    enum Kind : std::uint8_t {
        real,     ///< FFTW's "r2r".
        complex,  ///< FFTW's "dft": lines of complex numbers, two elements each.
        there,    ///< FFTW's "r2c", on one contiguous line of real numbers.
        back      ///< FFTW's "c2r", the inverse of "r2c".
    };

    FftwTransform() = default;
    /// Plans `count` lines of `cells` numbers each. `direction` is FFTW's kind of a real transform
    /// or the sign of a complex one. Planning neither reads nor writes the lines.
    FftwTransform(Kind kind, int direction, std::int64_t cells, std::int64_t count,
                  const Lines& from, const Lines& to);
    FftwTransform(FftwTransform&& other) noexcept;
    FftwTransform& operator=(FftwTransform&& other) noexcept;
    ~FftwTransform();

    /// Transforms the lines. Several threads may call this at the same time.
    void run(Number* from, Number* to) const;

private:
    using Plan = std::conditional_t<std::is_same_v<Number, float>, fftwf_plan, fftw_plan>;
    Kind kind_ = real;
    Plan plan_ = nullptr;
};

extern template class FftwTransform<float>;
extern template class FftwTransform<double>;

}  // namespace cascade
