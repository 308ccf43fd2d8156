// Quotes only the cells that need it; numbers that are not finite become empty cells.
#include "core/csv.h"

#include <fmt/format.h>

#include <cmath>

namespace cascade {

std::string csv_row(std::span<const std::string> cells) {
    std::string line;
    for (std::size_t k = 0; k < cells.size(); ++k) {
        if (k > 0) line += ',';
        const std::string& cell = cells[k];
        if (cell.find_first_of(",\"\r\n") == std::string::npos) {
            line += cell;
            continue;
        }
        line += '"';
        for (const char c : cell) line += c == '"' ? std::string("\"\"") : std::string(1, c);
        line += '"';
    }
    return line + "\n";
}

std::string csv_number(double value) {
    return std::isfinite(value) ? fmt::format("{:.9g}", value) : std::string();
}

std::string csv_number(double value, Precision precision) {
    return with_number(precision, [&](auto zero) {
        const auto number = static_cast<decltype(zero)>(value);
        return std::isfinite(number) ? fmt::format("{}", number) : std::string();
    });
}

}  // namespace cascade
