// Formats whole scripts: the examples, the built-in systems, and random scripts with random blanks
// and lines. Formatting must keep the meaning, and formatting again must change nothing.
#include "random_scripts.h"

#include "core/file.h"
#include "support/random_stream.h"
#include "support/same_meaning.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace cascade {
namespace {

std::vector<std::filesystem::path> scripts_below(const char* folder) {
    std::vector<std::filesystem::path> paths;
    const auto root = std::filesystem::path(CASCADE_SOURCE_DIR) / folder;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
        if (entry.path().extension() == ".cascade") paths.push_back(entry.path());
    }
    return paths;
}

TEST(Formatting, KeepsTheMeaningOfExamplesAndSystems) {
    for (const char* folder : {"examples", "lang/systems"}) {
        const auto paths = scripts_below(folder);
        EXPECT_GE(paths.size(), 3u);
        for (const auto& path : paths) {
            EXPECT_EQ(test::fault_of_formatting(read_file(path, 1u << 20).value()), "") << path;
        }
    }
}

/// The script with other blanks, line ends and comments in place of its own.
std::string disarranged(const std::string& script, std::uint64_t seed) {
    test::RandomStream random(seed);
    std::string text;
    for (std::size_t k = 0; k < script.size(); ++k) {
        const char c = script[k];
        const bool in_indentation = c == ' ' && k > 0 && script[k - 1] == '\n';
        if (c == ' ' && k > 0) {
            text.append(random.below(5) == 0 ? 1 + random.below(6) : in_indentation ? 0 : 1, ' ');
            if (random.below(40) == 0) text += '\t';
            if (script[k - 1] == ',' && random.below(6) == 0) text += "# inside\n   ";
        } else if (c == '\n') {
            if (random.below(8) == 0) text += "# behind ";
            text += random.below(9) == 0 ? "\r\n\n\n" : "\n";
            if (random.below(12) == 0) text += "    # alone\n";
        } else {
            text += c;
        }
    }
    return text;
}

TEST(Formatting, KeepsTheMeaningOfRandomScripts) {
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        const std::string script = test::random_script(seed);
        ASSERT_EQ(test::fault_of_formatting(script), "") << script;
        const std::string other = disarranged(script, seed);
        ASSERT_EQ(test::fault_of_formatting(other), "") << other;
        EXPECT_EQ(test::tree_of(script), test::tree_of(other)) << "a fault of this test";
    }
}

/// The script with a few characters removed, doubled, exchanged or inserted.
std::string damaged(std::string script, test::RandomStream& random) {
    static constexpr std::string_view put_in = "()[]{};:,.#'\n\r\t +-*/^=<>1a\"";
    static constexpr std::string_view signs[] = {"∇",   "∇²", "∇·", "√", "²", "⁻¹", "β", "∂",
                                                 "/∂t", "′",  "·",  "−", "Δ", "≤",  "₁", "\u0307"};
    for (std::uint32_t k = 1 + random.below(3); k > 0 && !script.empty(); --k) {
        const std::size_t at = random.below(script.size());
        switch (random.below(4)) {
            case 3: script.insert(at, signs[random.below(std::size(signs))]); break;
            case 0: script.erase(at, 1 + random.below(3)); break;
            case 1: script.insert(at, script.substr(random.below(script.size()), 4)); break;
            default: script.insert(at, 1, put_in[random.below(put_in.size())]); break;
        }
    }
    return script;
}

TEST(Formatting, KeepsTheMeaningOfWhatCanStillBeReadOfDamagedScripts) {
    test::RandomStream random(1);
    std::vector<std::string> scripts;
    for (const char* folder : {"examples", "lang/systems"}) {
        for (const auto& path : scripts_below(folder)) {
            scripts.push_back(read_file(path, 1u << 20).value());
            scripts.push_back(test::formatted_in(ScriptNotation::papers, scripts.back()).value());
        }
    }
    int readable = 0;
    for (int k = 0; k < 4000; ++k) {
        const std::string script = damaged(scripts[random.below(scripts.size())], random);
        const std::string fault = test::fault_of_formatting(script);
        if (fault.starts_with("it cannot be read")) continue;
        ASSERT_EQ(fault, "") << script;
        ++readable;
    }
    EXPECT_GT(readable, 500);
}

}  // namespace
}  // namespace cascade
