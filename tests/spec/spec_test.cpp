// The program reads the code blocks of the specification, and the tables of the specification are
// complete.
//
// spec/README.md says what the words after the fences mean. CASCADE_UPDATE=1 rewrites the expected
// messages.
#include "lang/library/library.h"
#include "lang/vocabulary/settings.h"
#include "run/script/script.h"
#include "support/same_meaning.h"
#include "tests/support/code_blocks.h"
#include "tests/spec/sound_kernels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace cascade {
namespace {

const std::filesystem::path spec_folder = std::filesystem::path(CASCADE_SOURCE_DIR) / "spec";

std::string read_text(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return std::move(text).str();
}

std::vector<std::filesystem::path> pages() {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(spec_folder)) {
        if (entry.path().extension() == ".md") paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end());
    paths.push_back(spec_folder.parent_path() / "README.md");
    paths.push_back(spec_folder.parent_path() / "docs" / "tutorial.md");
    return paths;
}

class CodeBlockTest : public testing::TestWithParam<std::filesystem::path> {
protected:
    void SetUp() override { page_ = read_text(GetParam()); }

    void check_script(const CodeBlock& block) {
        const Script script = load_script("script.cascade", block.body, ".");
        EXPECT_EQ(script.messages(false), "");
        EXPECT_EQ(test::fault_of_formatting(block.body), "");
        if (script.program) expect_sound_kernels(*script.program);
    }

    /// Compares the messages of a script with the text block after it, or rewrites this block.
    void check_messages(const CodeBlock& block, const CodeBlock* expected) {
        const Script script = load_script("script.cascade", block.body, ".");
        EXPECT_EQ(script.diagnostics.has_errors(), block.word == "cascade-error");
        const std::string messages = script.messages(false);
        EXPECT_NE(messages, "");
        ASSERT_TRUE(expected != nullptr && expected->word == "text")
            << "a text block with the messages is missing:\n"
            << messages;
        if (std::getenv("CASCADE_UPDATE") != nullptr) {
            updates_.push_back({*expected, messages});
        } else {
            EXPECT_EQ(messages, expected->body);
        }
    }

    void write_updates() {
        if (updates_.empty()) return;
        for (auto update = updates_.rbegin(); update != updates_.rend(); ++update) {
            const auto& [block, text] = *update;
            page_.replace(block.begin, block.end - block.begin, text);
        }
        std::ofstream(GetParam(), std::ios::binary) << page_;
    }

    std::string page_;
    std::vector<std::pair<CodeBlock, std::string>> updates_;
};

TEST_P(CodeBlockTest, SaysWhatTheProgramDoes) {
    const std::vector<CodeBlock> blocks = code_blocks(page_);
    for (std::size_t k = 0; k < blocks.size(); ++k) {
        const CodeBlock& block = blocks[k];
        const CodeBlock* next = k + 1 < blocks.size() ? &blocks[k + 1] : nullptr;
        SCOPED_TRACE(GetParam().string() + ":" + std::to_string(block.line));
        if (block.word == "cascade") {
            check_script(block);
        } else if (block.word == "cascade-error" || block.word == "cascade-warning") {
            check_messages(block, next);
        } else {
            EXPECT_THAT(block.word, testing::AnyOf("text", "sh", "c", "cpp", "cmake", "python"))
                << "an unknown kind of block";
        }
    }
    write_updates();
}

INSTANTIATE_TEST_SUITE_P(Pages, CodeBlockTest, testing::ValuesIn(pages()),
                         [](const auto& parameter) {
                             const std::filesystem::path& page = parameter.param;
                             const bool in_spec = page.parent_path() == spec_folder;
                             return (in_spec ? "spec_" : "top_") + page.stem().string();
                         });

TEST(CodeBlocks, AreFoundByTheirFences) {
    const auto blocks = code_blocks("text\n```cascade\na: 1\n\n```\n```\n```\n```text\nlast");
    ASSERT_EQ(blocks.size(), 3u);
    EXPECT_EQ(blocks[0].word, "cascade");
    EXPECT_EQ(blocks[0].body, "a: 1\n\n");
    EXPECT_EQ(blocks[0].line, 2u);
    EXPECT_EQ(blocks[0].begin, 16u);
    EXPECT_EQ(blocks[0].end, 22u);
    EXPECT_EQ(blocks[1].word, "");
    EXPECT_EQ(blocks[1].body, "");
    EXPECT_EQ(blocks[2].body, "last");
}

/// The cells of all rows of all tables of a page, without blanks around them.
std::vector<std::vector<std::string>> table_rows(const std::string& page) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(page);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("| ")) continue;
        std::vector<std::string> cells;
        std::istringstream row(line.substr(2));
        for (std::string cell; std::getline(row, cell, '|');) {
            cells.push_back(cell.substr(0, cell.find_last_not_of(' ') + 1));
            if (cells.back().starts_with(' ')) cells.back().erase(0, 1);
        }
        rows.push_back(std::move(cells));
    }
    return rows;
}

std::string_view word_of(Contexts places) {
    switch (places) {
        case Contexts::any: return "any";
        case Contexts::cells: return "cells";
        case Contexts::rates: return "rates";
        case Contexts::steps: return "steps";
        case Contexts::values: return "values";
        case Contexts::noisy: return "noisy";
        case Contexts::picture: return "picture";
    }
    return "";
}

/// Returns how the row of a function begins in functions.md: `a + b`, `not a`, `-a`, `name(`,
/// `name(e over domain)`, `name(e over near(d))`.
std::string beginning_of_row(Function function) {
    const FunctionInfo& row = info(function);
    const std::string spelling(row.spelling);
    if (const std::size_t name = spelling.find(' '); name != std::string::npos) {
        const std::string end = row.arity.most == 2 ? "(d))`" : ")`";
        return "`" + spelling.substr(0, name) + "(e" + spelling.substr(name) + end;
    }
    if (!row.is_operator) return "`" + spelling + "(";
    if (row.arity.most == 2) return "`a " + spelling + " b`";
    return function == Function::logical_not ? "`not a`" : "`" + spelling + "a`";
}

std::string words_of(Arity arity) {
    const std::string least = std::to_string(arity.least);
    if (arity.is_groups) {
        return "groups of " + least + (arity.most > arity.least ? ", or one more" : "");
    }
    const std::string most = std::to_string(arity.most);
    if (arity.is_range) return least + " to " + most;
    return arity.least == arity.most ? least : least + " or " + most;
}

TEST(FunctionsPage, HasARowForEveryFunction) {
    auto rows = table_rows(read_text(spec_folder / "functions.md"));
    std::erase_if(rows, [](const auto& row) { return row.size() < 4 || row[0][0] != '`'; });
    std::size_t of_language = 0;
    for (std::size_t k = 0; k < function_count; ++k) {
        const auto function = static_cast<Function>(k);
        if (info(function).spelling.starts_with('(')) continue;  // Only lowering makes it.
        ++of_language;
        const std::string beginning = beginning_of_row(function);
        const auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& cells) {
            return cells[0].starts_with(beginning);
        });
        ASSERT_NE(row, rows.end()) << beginning;
        EXPECT_EQ((*row)[1], words_of(info(function).arity)) << beginning;
        EXPECT_EQ((*row)[2], word_of(info(function).places)) << beginning;
    }
    // The checker writes integrals as sums.
    const auto is_integral = [](const auto& cells) { return cells[0].starts_with("`integral("); };
    EXPECT_EQ(std::count_if(rows.begin(), rows.end(), is_integral), 1);
    EXPECT_EQ(rows.size(), of_language + 1) << "a row is for no function";
}

std::string_view word_of(SettingBlock block) {
    constexpr std::array<std::string_view, 8> words{"stage",          "domain",         "side",
                                                    "picture",        "system",         "cells",
                                                    "stage of cells", "stage of fields"};
    return words[static_cast<std::size_t>(block)];
}

std::string_view word_of(Domains domains) {
    switch (domains) {
        case Domains::plane: return "plane";
        case Domains::surface: return "surface";
        case Domains::grid: return "grid";
        case Domains::model: return "model";
        case Domains::straight: return "straight";
        case Domains::bent: return "bent";
        case Domains::all: return "all";
        case Domains::fields:
        case Domains::crawling: break;  // No setting is limited to these.
    }
    return "";
}

std::string_view word_of(SettingValue value) {
    constexpr std::array<std::string_view, 8> words{"count",      "number",      "numbers",
                                                    "expression", "expressions", "word",
                                                    "words",      "text"};
    return words[static_cast<std::size_t>(value)];
}

TEST(NamesPage, HasARowForEverySetting) {
    auto rows = table_rows(read_text(spec_folder / "names.md"));
    std::erase_if(rows, [](const auto& row) {
        return row.size() < 6 || !setting_named(row[0].substr(1, row[0].size() - 2));
    });
    ASSERT_EQ(rows.size(), setting_rows().size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const SettingInfo& setting = setting_rows()[k];
        const std::vector<std::string>& row = rows[k];
        EXPECT_EQ(row[0], "`" + std::string(setting.word) + "`");
        EXPECT_EQ(row[1], word_of(setting.block)) << row[0];
        EXPECT_EQ(row[2], word_of(setting.domains)) << row[0];
        EXPECT_EQ(row[3], word_of(setting.value)) << row[0];
        EXPECT_EQ(row[4], setting.meaning) << row[0];
        std::string words;
        for (const std::string& word : words_taken_by(setting)) {
            words += (words.empty() ? "`" : " `") + word + "`";
        }
        EXPECT_EQ(row[5], words) << row[0];
    }
}

TEST(LibraryPage, HasARowForEverySystem) {
    auto rows = table_rows(read_text(spec_folder / "library.md"));
    std::erase_if(rows, [](const auto& row) { return row.size() < 4 || row[0][0] != '`'; });
    std::string stages;
    for (const LibraryText& text : library_texts()) {
        stages += "system_name: " + std::string(text.system_name()) + "\n";
    }
    const Script script = load_script("script.cascade", stages, ".");
    ASSERT_TRUE(script.program);
    ASSERT_EQ(script.program->systems.size(), library_texts().size());
    for (const System& system : script.program->systems) {
        const auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& cells) {
            return cells[0] == "`" + system.name + "`";
        });
        ASSERT_NE(row, rows.end()) << system.name;
        std::string species, parameters;
        for (const Quantity& quantity : system.quantities) {
            (quantity.is_species ? species : parameters) += " " + quantity.name;
        }
        EXPECT_EQ(" " + (*row)[2], species) << system.name;
        EXPECT_EQ(" " + (*row)[3], parameters) << system.name;
    }
    EXPECT_EQ(rows.size(), script.program->systems.size()) << "a row is for no system";
}

}  // namespace
}  // namespace cascade
