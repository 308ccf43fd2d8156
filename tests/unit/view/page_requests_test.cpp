// Requests of pages that lose their connection.
#include "view/page_requests.h"

#include <gtest/gtest.h>

namespace cascade {
namespace {

TEST(PageRequests, AreObeyedOnceOverAllConnections) {
    PageRequests requests;
    requests.name(1, "page");
    const auto first = requests.begin(1, 5);
    EXPECT_TRUE(first.is_new);
    const auto second = requests.begin(1, 6);
    EXPECT_EQ(requests.finish(*first.page, 5, "done"), 1U);

    // The answer to the first request was lost, and the second request is still being carried out.
    requests.close(1);
    requests.name(2, "page");
    const auto again = requests.begin(2, 5);
    EXPECT_FALSE(again.is_new);
    EXPECT_EQ(again.answer, "done");
    const auto pending = requests.begin(2, 6);
    EXPECT_FALSE(pending.is_new);
    EXPECT_FALSE(pending.answer);
    EXPECT_EQ(requests.finish(*second.page, 6, "done, too"), 2U) << "where the page is now";
    EXPECT_TRUE(requests.begin(2, 7).is_new);
}

TEST(PageRequests, OfPagesAreApart) {
    PageRequests requests;
    requests.name(1, "page");
    EXPECT_TRUE(requests.begin(1, 5).is_new);
    requests.name(2, "another");
    EXPECT_TRUE(requests.begin(2, 5).is_new);
    EXPECT_TRUE(requests.begin(3, 5).is_new) << "a page without a name";
    EXPECT_FALSE(requests.begin(3, 5).is_new);
    EXPECT_TRUE(requests.begin(3, 0).is_new);
    EXPECT_TRUE(requests.begin(3, 0).is_new);
}

TEST(PageRequests, KeepABoundedAmount) {
    PageRequests requests;
    for (PageId page = 1; page <= 1000; ++page) {
        requests.name(page, "page" + std::to_string(page));
        const auto begun = requests.begin(page, 1);
        requests.finish(*begun.page, 1, "done");
        requests.close(page);
    }
    requests.name(2000, "page1");
    EXPECT_TRUE(requests.begin(2000, 1).is_new) << "forgotten long ago";
    for (std::uint64_t id = 2; id < 1000; ++id) {
        requests.finish(*requests.begin(2000, id).page, id, "done");
    }
    EXPECT_FALSE(requests.begin(2000, 2).answer);
    EXPECT_TRUE(requests.begin(2000, 999).answer);
}

}  // namespace
}  // namespace cascade
