// libc++ before version 20 lacks std::from_chars() for floating-point numbers. With such a libc++,
// numbers are read by strtod() of the C library, which also rounds to the nearest number.
#include "core/decimal.h"

#include <cerrno>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <string>

namespace cascade {

#ifdef __cpp_lib_to_chars

std::from_chars_result from_decimal(const char* begin, const char* end, double& number) {
    return std::from_chars(begin, end, number);
}

#else

namespace {

/// The number of characters that from_chars() may read. Unlike strtod(), from_chars() accepts no
/// blanks, plus sign or hexadecimal numbers.
std::size_t length_of(const char* begin, const char* end) {
    const char* at = begin;
    if (at != end && *at == '-') ++at;
    if (at == end || *at == '+' || *at == '-' || std::isspace(static_cast<unsigned char>(*at))) {
        return 0;
    }
    // from_chars() reads "0x10" as the number 0.
    const bool is_hexadecimal = end - at > 1 && at[0] == '0' && (at[1] == 'x' || at[1] == 'X');
    return static_cast<std::size_t>((is_hexadecimal ? at + 1 : end) - begin);
}

}  // namespace

std::from_chars_result from_decimal(const char* begin, const char* end, double& number) {
    const std::string text(begin, length_of(begin, end));
    char* stop = nullptr;
    errno = 0;
    const double read = std::strtod(text.c_str(), &stop);
    const auto used = stop - text.c_str();
    if (used == 0) return {begin, std::errc::invalid_argument};
    // Denormal numbers are in range, although strtod() may set errno for them.
    const bool is_out = errno == ERANGE && (read == 0 || std::isinf(read));
    if (!is_out) number = read;
    return {begin + used, is_out ? std::errc::result_out_of_range : std::errc()};
}

#endif

}  // namespace cascade
