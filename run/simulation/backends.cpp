// The table of backends.
#include "run/simulation/backends.h"

#include "core/check.h"
#include "ir/interpreter.h"
#include "jit/jit.h"

#include <algorithm>
#include <array>

namespace cascade {

std::span<const BackendKind> backends() {
    static const std::array table{
        BackendKind{"jit", "Native code by LLVM", true, has_jit(),
                    [] { return "native code by " + describe_jit(); },
                    [](const BackendOptions& options) {
                        return make_jit({.lanes = options.lanes, .cache = options.cache});
                    }},
        BackendKind{"interp", "the interpreter", false, true,
                    [] { return std::string("interpreter only, without LLVM"); },
                    [](const BackendOptions&) -> Result<std::unique_ptr<Backend>> {
                        return make_interpreter();
                    }},
    };
    return table;
}

const BackendKind& backend_named(std::string_view name) {
    const auto found = std::ranges::find(backends(), name, &BackendKind::name);
    CHECK(found != backends().end(), "backends are named as in their table");
    return *found;
}

bool is_available(std::string_view name) { return backend_named(name).is_available; }

std::vector<std::string> available_backends() {
    std::vector<std::string> names;
    for (const BackendKind& each : backends()) {
        if (each.is_available) names.emplace_back(each.name);
    }
    return names;
}

const BackendKind& fastest_backend() {
    return *std::ranges::find_if(backends(), &BackendKind::is_available);
}

}  // namespace cascade
