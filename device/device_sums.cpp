// Calls the kernels of plane_kernels.h.
#include "device/device_sums.h"

#include "device/plane_kernels.h"

namespace cascade {
namespace {

constexpr std::size_t reduced_lanes = 8, squared_lanes = 16, fold_group = 64, check_lanes = 64;

std::int32_t whole(std::int64_t number) { return static_cast<std::int32_t>(number); }

}  // namespace

DeviceSums::DeviceSums(Device& device, const TextTarget& target, const PlaneLayout& layout)
    : device_(device.open()), layout_(layout) {
    const DeviceProgram& program = device.program(sum_kernels_text(target), target);
    row_parts_ = program.kernel("c_row_parts");
    row_values_ = program.kernel("c_row_values");
    fold_rows_ = program.kernel("c_fold_rows");
    row_squares_ = program.kernel("c_row_squares");
    square_sums_ = program.kernel("c_square_sums");
    parts_ = device_.buffer(row_count() * squared_lanes * sizeof(double));
    rows_ = device_.buffer(row_count() * sizeof(double));
    spare_ = device_.buffer(row_count() * sizeof(double));
}

void DeviceSums::reduce(ReductionKind kind, const DevicePlane& plane, std::int64_t cells,
                        const DeviceBuffer& aggregates, std::uint32_t number) {
    const auto kind_number = static_cast<std::int32_t>(kind);
    row_parts_.set(plane.buffer, plane.origin, parts_, kind_number, whole(layout_.width),
                   whole(layout_.height), layout_.stride, layout_.slice_stride);
    device_.launch(row_parts_, reduced_lanes, row_count(), reduced_lanes);
    row_values_.set(parts_, rows_, kind_number, whole(layout_.width));
    device_.launch(row_values_, 1, row_count(), 1);
    fold_rows_.set(rows_, spare_, whole(layout_.row_count()), kind_number,
                   static_cast<double>(cells), aggregates, static_cast<std::int32_t>(number));
    device_.launch(fold_rows_, fold_group, 1, fold_group);
}

std::vector<double> DeviceSums::squares(const DevicePlane& plane, std::int64_t counted) {
    row_squares_.set(plane.buffer, plane.origin, parts_, whole(layout_.width),
                     whole(layout_.height), layout_.stride, layout_.slice_stride, counted);
    device_.launch(row_squares_, squared_lanes, row_count(), squared_lanes);
    square_sums_.set(parts_, rows_);
    device_.launch(square_sums_, 1, row_count(), 1);
    std::vector<double> sums(row_count());
    device_.read(rows_, 0, sums.data(), sums.size() * sizeof(double));
    return sums;
}

DeviceCheck::DeviceCheck(Device& device, const TextTarget& target, const PlaneLayout& layout)
    : device_(device.open()),
      layout_(layout),
      kernel_(device.program(plane_kernels_text(target), target).kernel("c_not_finite")),
      flag_(device_.buffer(sizeof(std::int32_t))) {}

bool DeviceCheck::are_finite(const DeviceBuffer& buffer, std::size_t planes) {
    std::int32_t flag = 0;
    device_.write(flag_, 0, &flag, sizeof flag);
    for (std::size_t k = 0; k < planes; ++k) {
        const std::int64_t origin =
            static_cast<std::int64_t>(k) * layout_.size() + layout_.offset(0, 0);
        kernel_.set(buffer, origin, flag_, whole(layout_.width), whole(layout_.height),
                    layout_.stride, layout_.slice_stride);
        device_.launch(kernel_, check_lanes, static_cast<std::size_t>(layout_.row_count()),
                       check_lanes);
    }
    device_.read(flag_, 0, &flag, sizeof flag);
    return flag == 0;
}

}  // namespace cascade
