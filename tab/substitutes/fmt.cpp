// The library fmt, which exists only as native code: its functions are compiled here, and declared
// everywhere else.
#define FMT_HEADER_ONLY
#include <fmt/format-inl.h>

namespace {

// The compiler leaves out inline functions that nobody takes.
[[gnu::used]] const auto vformat =
    static_cast<std::string (*)(fmt::string_view, fmt::format_args)>(&fmt::vformat);
[[gnu::used]] const auto throw_format_error = &fmt::detail::throw_format_error;

}  // namespace
