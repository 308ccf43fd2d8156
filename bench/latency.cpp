// Measures how long a user waits.
#include "bench/latency.h"

#include "bench/cascade_side.h"
#include "jit/jit.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <functional>
#include <string>
#include <vector>

namespace cascade::bench {
namespace {

constexpr int repetitions = 21;

double milliseconds_of(const std::function<void()>& work) {
    const auto before = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> took =
        std::chrono::steady_clock::now() - before;
    return took.count();
}

/// The median time of several repetitions. `work` gets the number of the repetition.
double median_of(const std::function<void(int)>& work) {
    std::vector<double> times;
    for (int n = 0; n < repetitions; ++n) times.push_back(milliseconds_of([&] { work(n); }));
    std::nth_element(times.begin(), times.begin() + repetitions / 2, times.end());
    return times[repetitions / 2];
}

void print(const std::string& what, double milliseconds, double wanted) {
    fmt::print("{:<58}{:>9.2f} ms   (wanted: at most {} ms)\n", what, milliseconds, wanted);
}

/// Gray-Scott with another number in its equation for each repetition, so that its kernel is new.
std::string changed_equation(int repetition) {
    std::string text = gray_scott_text({64, 64});
    const std::string old = "feed * (1 - u)";
    const std::size_t place = text.find(old);
    if (place == std::string::npos) std::abort();
    return text.replace(place, old.size(), fmt::format("feed * (1.00{:02} - u)", repetition + 1));
}

std::string changed_number(int repetition) {
    std::string text = gray_scott_text({64, 64});
    const std::string old = "feed: 0.037";
    const std::size_t place = text.find(old);
    if (place == std::string::npos) std::abort();
    return text.replace(place, old.size(), fmt::format("feed: 0.037{:02}", repetition + 1));
}

}  // namespace

std::unique_ptr<Backend> first_use(int lanes) {
    std::unique_ptr<Backend> backend;
    const double took = milliseconds_of([&] {
        auto made = make_jit({lanes, JitOptions{}.optimise});
        if (!made) {
            std::fprintf(stderr, "cascade_bench: %s\n", made.error().message.c_str());
            std::exit(1);
        }
        backend = std::move(*made);
        CascadeSide(turing_text({64, 64}), *backend).advance(1);
    });
    fmt::print("{}\n", describe_jit());
    print("text to first step, first use (turing_spots, 64 x 64)", took, 50);
    return backend;
}

void later_use(Backend& backend) {
    print("text to first step, another equation (Gray-Scott)",
          median_of([&](int n) { CascadeSide(changed_equation(n), backend).advance(1); }), 20);
    print("text to first step, another uniform number: no compiling",
          median_of([&](int n) { CascadeSide(changed_number(n), backend).advance(1); }), 20);
    const CascadeSide prepared(turing_text({64, 64}), backend);
    print("2000 steps of Turing's system on 64 x 64", median_of([&](int) {
              Stepper stepper = prepared.fresh_stepper();
              for (int n = 0; n < 2000; n += 50) {
                  stepper.advance(n, 50, true);
                  stepper.keep();
              }
          }),
          10);
}

}  // namespace cascade::bench
