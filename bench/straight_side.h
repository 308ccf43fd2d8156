// The fields of straight C++. They start with the values of Cascade's side, and a function of
// straight_cpp.h takes the steps.
#pragma once

#include "bench/cascade_side.h"
#include "bench/straight_cpp.h"
#include "core/plane.h"

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

namespace cascade::bench {

/// A plane as straight C++ would allocate it: aligned rows from the standard allocator. (Cascade
/// also asks the system for huge pages, which is a part of the comparison.)
template <typename T>
class StraightPlane {
public:
    StraightPlane() = default;
    /// Copies the values of a plane of Cascade.
    explicit StraightPlane(const Plane<T>& like)
        : offset_(like.layout().offset(0, 0)),
          data_(static_cast<T*>(std::aligned_alloc(64, rounded_bytes(like.layout())))) {
        if (!data_) std::abort();
        std::memcpy(data_.get(), like.origin() - offset_, Plane<T>::bytes(like.layout()));
    }

    bool empty() const { return !data_; }
    T* origin() { return data_.get() + offset_; }
    const T* origin() const { return data_.get() + offset_; }

private:
    static std::size_t rounded_bytes(const PlaneLayout& layout) {
        return (Plane<T>::bytes(layout) + 63) / 64 * 64;
    }
    struct Free {
        void operator()(T* data) const { std::free(data); }
    };
    std::int64_t offset_ = 0;
    std::unique_ptr<T[], Free> data_;
};

class StraightSide {
public:
    /// `varying` is the name of the parameter that varies by cell, or empty.
    StraightSide(const CascadeSide& like, const std::string& varying);

    void advance(StraightStep step, std::int64_t count);

    /// Copies of the species.
    std::vector<Field> species() const;

private:
    StraightConstants constants_;
    std::vector<StraightPlane<float>> now_, next_;
    StraightPlane<float> varying_, scratch_;
    StraightPlane<std::uint8_t> frozen_;
    Grid grid_;
    PlaneLayout layout_;
};

}  // namespace cascade::bench
