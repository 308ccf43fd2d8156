// Messages in streams of bytes, whole, in pieces, and broken.
#include "lsp/frames.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <random>

namespace cascade::lsp {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> bodies(FrameReader& reader) {
    std::vector<std::string> list;
    while (auto frame = reader.next()) {
        list.push_back(frame->is_too_large ? "too large" : frame->body);
    }
    return list;
}

std::string fault_of(const std::string& bytes) {
    FrameReader reader;
    reader.add(bytes);
    EXPECT_THAT(bodies(reader), IsEmpty());
    return reader.fault();
}

TEST(Frames, ReadsWhatIsFramed) {
    FrameReader reader;
    reader.add(framed("{}") + framed("") + framed("ä\r\n\r\n"));
    EXPECT_THAT(bodies(reader), ElementsAre("{}", "", "ä\r\n\r\n"));
}

TEST(Frames, ReadsSingleBytes) {
    FrameReader reader;
    std::vector<std::string> list;
    for (const char byte : framed("one") + framed("two")) {
        reader.add({&byte, 1});
        for (std::string& body : bodies(reader)) list.push_back(std::move(body));
    }
    EXPECT_THAT(list, ElementsAre("one", "two"));
}

TEST(Frames, IgnoresOtherFieldsAndTheCaseOfLetters) {
    FrameReader reader;
    reader.add(
        "Content-Type: application/x; charset=utf-8\r\ncontent-LENGTH:  2 \r\n\r\nab"
        "Content-Length: 1\n\nc");
    EXPECT_THAT(bodies(reader), ElementsAre("ab", "c"));
}

TEST(Frames, SaysWhatIsWrong) {
    EXPECT_THAT(fault_of("hello\r\n"), HasSubstr("no colon"));
    EXPECT_THAT(fault_of("Content-Type: x\r\n\r\n"), HasSubstr("no Content-Length"));
    for (const char* number : {"-1", "", "1x", "0x10", "1 2", "99999999999999999999999"}) {
        EXPECT_THAT(fault_of(std::string("Content-Length: ") + number + "\r\n"),
                    HasSubstr("not a number"))
            << number;
    }
    EXPECT_THAT(fault_of(std::string(largest_header + 1, 'x')), HasSubstr("more than 4096"));
    EXPECT_THAT(fault_of(std::string(largest_header, 'x')), IsEmpty());
}

TEST(Frames, DropsALargeMessageAsItArrives) {
    FrameReader reader;
    reader.add("Content-Length: " + std::to_string(largest_message + 1) + "\r\n\r\n");
    const std::string part(1 << 20, 'x');
    for (int k = 0; k < 64; ++k) {
        reader.add(part);
        EXPECT_FALSE(reader.next());
    }
    reader.add("x" + framed("next"));
    EXPECT_THAT(bodies(reader), ElementsAre("too large", "next"));
}

/// Random pieces of headers, numbers and bodies. The reader must end with a fault or ask for more,
/// and the same bytes in other pieces must give the same messages.
TEST(Frames, RandomBytes) {
    const char* const seed_text = std::getenv("CASCADE_TEST_SEED");
    const auto seed = seed_text ? static_cast<unsigned>(std::strtoul(seed_text, nullptr, 10))
                                : std::random_device()();
    SCOPED_TRACE("CASCADE_TEST_SEED=" + std::to_string(seed));
    std::mt19937 random(seed);
    const std::string parts[] = {"Content-Length: ",
                                 "Content-Length:",
                                 "5",
                                 "0",
                                 "12",
                                 "\r\n",
                                 "\r\n\r\n",
                                 "\n",
                                 "x",
                                 ":",
                                 "{}",
                                 "\r",
                                 std::string(1, '\0'),
                                 "99999999999",
                                 framed("hello")};
    for (int trial = 0; trial < 20000; ++trial) {
        std::string bytes;
        for (auto count = random() % 12; count-- > 0;) bytes += parts[random() % std::size(parts)];
        FrameReader whole, pieces;
        whole.add(bytes);
        const auto expected = bodies(whole);
        std::vector<std::string> found;
        for (std::size_t at = 0; at < bytes.size();) {
            const std::size_t size = 1 + random() % 7;
            pieces.add(std::string_view(bytes).substr(at, size));
            for (std::string& body : bodies(pieces)) found.push_back(std::move(body));
            at += size;
        }
        ASSERT_EQ(found, expected) << testing::PrintToString(bytes);
        ASSERT_EQ(pieces.fault(), whole.fault()) << testing::PrintToString(bytes);
    }
}

}  // namespace
}  // namespace cascade::lsp
