// Notes of the library: the description of a file, and the words to search in.
#include "lang/print/library_note.h"

#include "tests/unit/lang/check_helpers.h"

#include <gtest/gtest.h>

namespace cascade {
namespace {

constexpr LibraryText example_text = {
    "example.cascade",
    "# Example: it grows\n# and grows. Fast.\n# A. Author, 1999.\n\n"
    "system example {\n  u: 1  ## the Activator\n  u' = u\n}\n"};

TEST(LibraryNote, ReadsTheHead) {
    const LibraryNote note = note_of(example_text);
    EXPECT_EQ(note.about, "Example: it grows and grows. Fast.");
    EXPECT_EQ(note.lines, (std::vector<std::string>{"Example: it grows", "and grows. Fast.",
                                                    "A. Author, 1999."}));
}

TEST(LibraryNote, FindsWords) {
    const LibraryNote note = note_of(example_text);
    for (const char* word : {"exam", "GROWS", "author, 19", "activator"}) {
        EXPECT_TRUE(note.mentions(word)) << word;
    }
    for (const char* word : {"shrinks", "system", "u'"}) EXPECT_FALSE(note.mentions(word)) << word;
}

TEST(LibraryNote, AddsAStageOnlyWhereThereIsNone) {
    EXPECT_EQ(starting_script(example_text),
              std::string(example_text.text) + "\nstage first: example { }\n");
    for (const LibraryText& each : library_texts()) {
        EXPECT_FALSE(note_of(each).about.empty()) << each.file_name;
        const auto checked = test::check_text(starting_script(each));
        EXPECT_EQ(checked->faults(), std::vector<std::string>{}) << each.file_name;
        ASSERT_TRUE(checked->program) << each.file_name;
        EXPECT_FALSE(checked->program->stages.empty()) << each.file_name;
    }
}

}  // namespace
}  // namespace cascade
