// Every script that `cascade new` prints can be run: each text of the library with its own stage,
// or with a stage that is added.
#include "ran_text.h"

#include "lang/library/library.h"
#include "lang/print/library_note.h"
#include "tissue/tissue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cascade {
namespace {

Ran run_start_of(const LibraryText& text) {
    Overrides few;
    few.steps = 3;
    return run_text(starting_script(text), {"interp", 0, 2}, few);
}

TEST(StartingScripts, EverySystemRuns) {
    for (const LibraryText& text : library_texts()) {
        SCOPED_TRACE(text.system_name());
        const Ran ran = run_start_of(text);
        ASSERT_TRUE(ran.simulation);
        EXPECT_EQ(ran.failure, "");
        EXPECT_GT(ran.last().steps, 0);
    }
}

TEST(StartingScripts, EveryBlockOfCellsAndEveryShapeRuns) {
    for (const auto texts : {library_cells(), library_shapes()}) {
        for (const LibraryText& text : texts) {
            SCOPED_TRACE(text.system_name());
            const Ran ran = run_start_of(text);
            ASSERT_TRUE(ran.simulation);
            EXPECT_EQ(ran.failure, "");
            EXPECT_THAT(ran.warnings, testing::IsEmpty());
            ASSERT_TRUE(ran.last().tissue());
            EXPECT_GT(ran.last().tissue()->count(), 5u);
        }
    }
}

}  // namespace
}  // namespace cascade
