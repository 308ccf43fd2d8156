// Scripts of the examples, the library and the spec in which a few tokens are removed, doubled,
// exchanged or taken from another script. Each run of the test makes other changes and prints its
// seed.
#include "core/file.h"
#include "sound_check.h"
#include "support/last_script.h"
#include "support/new_seed.h"
#include "support/random_stream.h"
#include "support/code_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace cascade::test {
namespace {

/// Splits a text into words, numbers, quoted texts, line ends and single signs. Blanks belong to
/// the token after them.
std::vector<std::string> tokens_of(std::string_view text) {
    const auto is_word = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c < 0;
    };
    std::vector<std::string> tokens;
    for (std::size_t at = 0; at < text.size();) {
        std::size_t end = std::min(text.find_first_not_of(' ', at), text.size() - 1);
        if (text[end] == '"') end = std::min(text.find('"', end + 1), text.size() - 1);
        if (text[end] == '#') end = std::min(text.find('\n', end), text.size()) - 1;
        const bool begins_word = is_word(text[end++]);
        while (begins_word && end < text.size() && is_word(text[end])) ++end;
        tokens.emplace_back(text.substr(at, end - at));
        at = end;
    }
    return tokens;
}

std::vector<std::vector<std::string>> sample_scripts() {
    constexpr std::size_t longest = 1200;
    const std::filesystem::path root = CASCADE_SOURCE_DIR;
    std::vector<std::filesystem::path> files;
    for (const char* folder : {"examples", "lang", "spec"}) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
            const auto ending = entry.path().extension();
            if (ending == ".cascade" || ending == ".md") files.push_back(entry.path());
        }
    }
    std::ranges::sort(files);
    std::vector<std::vector<std::string>> scripts;
    for (const auto& path : files) {
        const std::string text = read_file(path, 1 << 22).value_or("");
        if (path.extension() == ".cascade") {
            if (text.size() < longest) scripts.push_back(tokens_of(text));
            continue;
        }
        for (const CodeBlock& block : code_blocks(text)) {
            if (block.word.starts_with("cascade")) scripts.push_back(tokens_of(block.body));
        }
    }
    return scripts;
}

void mutate(std::vector<std::string>& script, const std::vector<std::string>& other,
            RandomStream& random) {
    if (script.empty() || other.empty()) return;
    const auto at = script.begin() + random.below(script.size());
    const auto end = at + 1 + random.below(std::min<std::ptrdiff_t>(6, script.end() - at));
    const auto from = other.begin() + random.below(other.size());
    const auto to = from + 1 + random.below(std::min<std::ptrdiff_t>(6, other.end() - from));
    switch (random.below(6)) {
        case 0: script.erase(at); return;
        case 1: script.erase(at, end); return;
        case 2: script.insert(at, std::string(*at)); return;
        case 3: std::iter_swap(at, script.begin() + random.below(script.size())); return;
        case 4: *at = *from; return;
        default: script.insert(at, from, to);
    }
}

TEST(MutatedScripts, AreProgramsOrHaveMessages) {
    constexpr int count = 10'000;
    const std::vector<std::vector<std::string>> samples = sample_scripts();
    ASSERT_GT(samples.size(), 200U);
    RandomStream random(new_seed());
    LastScript last;
    int right = 0;
    for (int k = 0; k < count; ++k) {
        std::vector<std::string> script = random.pick(std::span(samples));
        for (std::uint32_t times = 1 + random.below(4); times > 0; --times) {
            mutate(script, random.pick(std::span(samples)), random);
        }
        std::string text;
        for (const std::string& token : script) text += token;
        last.tell(text);
        right += is_checked_soundly(text) ? 1 : 0;
    }
    std::printf("%d of %d scripts are programs\n", right, count);
}

}  // namespace
}  // namespace cascade::test
