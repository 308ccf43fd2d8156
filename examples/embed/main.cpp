// Runs a pattern inside another program: parses a script, shows its errors, takes steps, reads
// fields, and cancels.

#include <cascade/cascade.h>

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <string>
#include <vector>

namespace {

const char* const script =
    "domain { grid: 64, 32; seed: 4 }\n"
    "stage spots: turing_spots {\n"
    "  iterations: 6000\n"
    "  ka: 1/80\n"
    "}\n";

/// This script has a mistake in its second line. The library reports where, and does not run
/// the script.
bool shows_mistakes() {
    const cascade::Pattern wrong("stage spots: turing_spots {\n  betta: 12\n}\n");
    if (wrong.ok()) return false;
    std::cout << wrong.messages();
    const std::vector<cascade::Message> messages = wrong.diagnostics();
    return messages.size() == 1 && messages[0].line == 2 && messages[0].column == 3;
}

/// Draws the pattern with characters, using every second row, because characters are twice as high
/// as wide.
void draw(const cascade::Pattern& pattern, const std::vector<float>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const std::string ink = "@#*+-. ";
    for (std::int64_t row = 0; row < pattern.height(); row += 2) {
        for (std::int64_t column = 0; column < pattern.width(); ++column) {
            const float value = values[static_cast<std::size_t>(row * pattern.width() + column)];
            const float share = (value - *low) / (*high - *low);
            std::cout << ink[static_cast<std::size_t>(share * 6.0F)];
        }
        std::cout << '\n';
    }
}

}  // namespace

int main() {
    std::cout << "Cascade " << cascade::library_version() << '\n';
    if (!shows_mistakes()) return 1;

    cascade::Pattern pattern(script);
    if (!pattern.ok()) {
        std::cerr << pattern.messages() << pattern.error() << '\n';
        return 2;
    }
    while (pattern.ok() && !pattern.finished()) {
        pattern.step(2000);
        std::cout << pattern.current_stage() << ": " << pattern.steps() << " steps\n";
    }
    const std::vector<float> values = pattern.values("b");
    if (values.size() != 64U * 32U) {
        std::cerr << pattern.error() << '\n';
        return 3;
    }
    draw(pattern, values);
}
