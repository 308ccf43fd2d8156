// The exception by which an executor reports that it cannot continue.
#pragma once

#include "core/result.h"

#include <exception>
#include <optional>
#include <utility>

namespace cascade {

/// Thrown by an executor whose device fails, for example because it was lost. Values that nobody
/// has fetched are then lost, too.
struct ExecutorFailure : std::exception {
    explicit ExecutorFailure(Failure why) : failure(std::move(why)) {}
    const char* what() const noexcept override { return failure.message.c_str(); }

    Failure failure;
};

/// Calls `work`. Returns the failure if an executor could not continue; else nothing. Where there
/// are no exceptions, as in WebAssembly, executors do not fail.
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
