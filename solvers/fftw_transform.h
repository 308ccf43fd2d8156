// A transform of lines of numbers by FFTW (internal to solvers/). The first one loads FFTW.
#pragma once

#include <fftw3.h>

#include <cstdint>
#include <type_traits>

namespace cascade {

/// An estimated plan, because measuring would choose differently from run to run. Memory for run()
/// must be aligned like the constructor's.
template <typename Number>
class FftwTransform {
public:
    /// The layout of lines: the elements from one number to the next and from one line to the next.
    struct Lines {
        Number* at;
        std::int64_t stride, distance;
    };
    enum Kind : std::uint8_t {
        real,     ///< FFTW's "r2r".
        complex,  ///< "dft": lines of complex numbers, two elements each.
        there,    ///< "r2c", on one contiguous line of real numbers.
        back      ///< "c2r", its inverse.
    };

    FftwTransform() = default;
    /// `count` lines of `cells` numbers each. `direction` is FFTW's kind of a real transform and
    /// the sign of a complex one. Neither reads nor writes the lines.
    FftwTransform(Kind kind, int direction, std::int64_t cells, std::int64_t count,
                  const Lines& from, const Lines& to);
    FftwTransform(FftwTransform&& other) noexcept;
    FftwTransform& operator=(FftwTransform&& other) noexcept;
    ~FftwTransform();

    /// Threads may share a transform.
    void run(Number* from, Number* to) const;

private:
    using Plan = std::conditional_t<std::is_same_v<Number, float>, fftwf_plan, fftw_plan>;
    Kind kind_ = real;
    Plan plan_ = nullptr;
};

extern template class FftwTransform<float>;
extern template class FftwTransform<double>;

}  // namespace cascade
