// The library fmt, which exists only as native code: its functions are compiled here, and declared
// everywhere else.
#define FMT_HEADER_ONLY
#include <fmt/format-inl.h>

namespace {

// The compiler omits inline functions whose address is not taken.
[[gnu::used]] const auto vformat =
    static_cast<std::string (*)(fmt::string_view, fmt::format_args)>(&fmt::vformat);
[[gnu::used]] const auto throw_format_error = &fmt::detail::throw_format_error;

}  // namespace
