// The exception by which an executor reports that it cannot continue.
#pragma once

#include "core/result.h"

#include <exception>
#include <optional>
#include <utility>

namespace cascade {

/// Thrown by an executor whose device fails, for example because the connection to the device was
/// lost. Values that are only on the device are lost, too.
struct ExecutorFailure : std::exception {
    explicit ExecutorFailure(Failure why) : failure(std::move(why)) {}
    const char* what() const noexcept override { return failure.message.c_str(); }

    Failure failure;
};

/// Calls `work`. Returns the failure if an executor could not continue, otherwise nullopt. On
/// targets without exceptions, such as WebAssembly, executors do not fail.
template <typename Work>
std::optional<Failure> failure_in(const Work& work) {
#ifdef __cpp_exceptions
    try {
        work();
    } catch (const ExecutorFailure& error) {
        return error.failure;
    }
#else
    work();
#endif
    return std::nullopt;
}

}  // namespace cascade
