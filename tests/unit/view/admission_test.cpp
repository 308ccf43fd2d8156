// Each of the rules by which the server admits requests.
#include "view/admission.h"

#include "core/temporary_file.h"

#include <gmock/gmock.h>

#include <set>

namespace cascade {
namespace {

constexpr std::string_view session_token = "00112233445566778899aabbccddeeff";

RequestHead page_request() {
    RequestHead head;
    head.method = "GET";
    head.target = "/";
    head.host = "127.0.0.1:4000";
    return head;
}

RequestHead session_request() {
    RequestHead head = page_request();
    head.target = "/session?token=00112233445566778899aabbccddeeff";
    head.origin = "http://127.0.0.1:4000";
    head.has_origin = true;
    head.is_upgrade = true;
    return head;
}

/// The HTTP status of the refusal, or 0 if the request is admitted.
unsigned status_of(const RequestHead& head) {
    const auto refusal = Admission(4000, std::string(session_token)).refuse(head);
    return refusal ? refusal->status : 0;
}

TEST(Admission, TakesItsOwnPage) {
    EXPECT_EQ(status_of(page_request()), 0U);
    EXPECT_EQ(status_of(session_request()), 0U);
    for (const std::string_view name : {"127.0.0.1:4000", "localhost:4000", "[::1]:4000"}) {
        const std::string origin = "http://" + std::string(name);
        RequestHead head = session_request();
        head.host = name;
        head.origin = origin;
        EXPECT_EQ(status_of(head), 0U) << name;
    }
}

TEST(Admission, RefusesHostsThatAreNotItsAddress) {
    for (const std::string_view host :
         {"", "127.0.0.1", "127.0.0.1:4001", "127.0.0.1:40000", "localhost", "LOCALHOST:4000",
          "evil.example:4000", "127.0.0.1.evil.example:4000", "localhost.:4000", "::1:4000",
          "127.0.0.2:4000", "0.0.0.0:4000", "127.1:4000", " 127.0.0.1:4000", "a@127.0.0.1:4000"}) {
        RequestHead head = page_request();
        head.host = host;
        EXPECT_EQ(status_of(head), 403U) << host;
    }
    RequestHead head = page_request();
    head.host.reset();
    EXPECT_EQ(status_of(head), 403U);
}

TEST(Admission, RefusesOriginsOfOtherSites) {
    for (const std::string_view origin :
         {"", "null", "http://evil.example", "https://127.0.0.1:4000", "http://127.0.0.1:4001",
          "http://127.0.0.1", "http://localhost:4000", "http://127.0.0.1:4000/",
          "127.0.0.1:4000"}) {
        RequestHead head = session_request();
        head.origin = origin;
        EXPECT_EQ(status_of(head), 403U) << origin;
        head.is_upgrade = false;
        head.target = "/";
        EXPECT_EQ(status_of(head), 403U) << origin;
    }
    RequestHead none = session_request();
    none.origin.reset();
    EXPECT_EQ(status_of(none), 403U) << "an origin that comes twice";
    none.has_origin = false;
    EXPECT_EQ(status_of(none), 403U) << "no origin";
}

TEST(Admission, RefusesMethodsThatCouldChangeSomething) {
    for (const std::string_view method :
         {"POST", "PUT", "DELETE", "PATCH", "OPTIONS", "CONNECT", "TRACE", "get", ""}) {
        RequestHead head = page_request();
        head.method = method;
        EXPECT_EQ(status_of(head), 405U) << method;
    }
    RequestHead head = page_request();
    head.method = "HEAD";
    EXPECT_EQ(status_of(head), 0U);
    head = session_request();
    head.method = "HEAD";
    EXPECT_EQ(status_of(head), 403U);
}

TEST(Admission, RefusesSocketsWithoutTheToken) {
    for (const std::string_view target : {"/session", "/session?", "/session?token=",
                                          "/session?token=00112233445566778899aabbccddee",
                                          "/session?token=00112233445566778899aabbccddeefe",
                                          "/session?token=00112233445566778899aabbccddeeff0",
                                          "/session?token=00112233445566778899AABBCCDDEEFF",
                                          "/session?x=1&token=00112233445566778899aabbccddeeff"}) {
        RequestHead head = session_request();
        head.target = target;
        EXPECT_EQ(status_of(head), 403U) << target;
    }
    RequestHead head = session_request();
    head.target = "/?token=00112233445566778899aabbccddeeff";
    EXPECT_EQ(status_of(head), 404U);
    head = session_request();
    head.is_upgrade = false;
    EXPECT_EQ(status_of(head), 426U);
}

TEST(Admission, TokensAreRandomAndComparedWhole) {
    std::set<std::string> tokens;
    for (int k = 0; k < 100; ++k) {
        const auto made = secret_digits();
        ASSERT_TRUE(made.has_value());
        EXPECT_THAT(*made, testing::MatchesRegex("[0-9a-f]+"));
        EXPECT_EQ(made->size(), 32U);
        tokens.insert(*made);
    }
    EXPECT_EQ(tokens.size(), 100U);
    EXPECT_TRUE(same_secret("", ""));
    EXPECT_TRUE(same_secret("abc", "abc"));
    for (const std::string_view other : {"", "ab", "abcd", "xbc", "axc", "abx"}) {
        EXPECT_FALSE(same_secret("abc", other)) << other;
    }
}

}  // namespace
}  // namespace cascade
