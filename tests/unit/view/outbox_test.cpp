// Messages that wait for a page: texts keep their order, frames replace each other, and the sender
// is woken when it has something to do.
#include "view/outbox.h"

#include <gtest/gtest.h>

namespace cascade {
namespace {

using Added = Outbox::Added;

SharedBytes bytes(std::string text) { return std::make_shared<const std::string>(std::move(text)); }

/// The next message as "text:…" or "frame:…", or "" if none waits.
std::string next_of(Outbox& outbox) {
    const auto message = outbox.next();
    if (!message) return "";
    return (message->is_text ? "text:" : "frame:") + *message->bytes;
}

TEST(Outbox, NewerFramesReplaceThoseOfTheirKind) {
    Outbox outbox(100);
    EXPECT_EQ(outbox.add_frame(1, bytes("old plane")), Added::sleeping);
    EXPECT_EQ(outbox.add_frame(2, bytes("curve")), Added::awake);
    EXPECT_EQ(outbox.add_text("first"), Added::awake);
    EXPECT_EQ(outbox.add_frame(1, bytes("new plane")), Added::awake);
    EXPECT_EQ(outbox.add_text("second"), Added::awake);
    EXPECT_EQ(next_of(outbox), "text:first");
    EXPECT_EQ(next_of(outbox), "text:second");
    EXPECT_EQ(next_of(outbox), "frame:new plane") << "it has the place of the one it replaces";
    EXPECT_EQ(next_of(outbox), "frame:curve");
    EXPECT_EQ(outbox.add_frame(1, bytes("late")), Added::awake) << "nobody has found it empty";
    EXPECT_EQ(next_of(outbox), "frame:late");
    EXPECT_EQ(next_of(outbox), "");
    EXPECT_EQ(outbox.add_frame(1, bytes("again")), Added::sleeping);
}

TEST(Outbox, TextsThatNobodyReadsAreBounded) {
    Outbox outbox(10);
    EXPECT_EQ(outbox.add_text("12345"), Added::sleeping);
    EXPECT_EQ(outbox.add_text("67890"), Added::awake);
    EXPECT_EQ(outbox.add_text("x"), Added::overflow);
    EXPECT_EQ(next_of(outbox), "text:12345");
    EXPECT_EQ(outbox.add_text("x"), Added::awake) << "there is room again";
    EXPECT_EQ(next_of(outbox), "text:67890");
    EXPECT_EQ(next_of(outbox), "text:x");
    EXPECT_EQ(next_of(outbox), "");
}

}  // namespace
}  // namespace cascade
