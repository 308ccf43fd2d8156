// Typed ids: which operations compile, and lists with ids as indices.
#include "core/id.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <type_traits>
#include <vector>

namespace cascade::test {
namespace {

using ::testing::ElementsAre;

using Apple = Id<struct AppleTag>;
using Pear = Id<struct PearTag>;

static_assert(!std::is_convertible_v<Apple, Pear> && !std::is_constructible_v<Apple, Pear>);
static_assert(!std::is_convertible_v<int, Apple> && !std::is_convertible_v<Apple, int>);
static_assert(!std::is_invocable_v<decltype([](auto& list, auto id) -> decltype(list[id]) {
                                       return list[id];
                                   }),
                                   IdVector<Apple, int>&, Pear>);

TEST(Ids, AreTheirNumbers) {
    EXPECT_EQ(Apple(3).index(), 3u);
    EXPECT_EQ(Apple(), Apple(0));
    EXPECT_LT(Apple(1), Apple(2));
}

TEST(Ids, ArePlacesOfLists) {
    IdVector<Apple, char> letters;
    for (const char letter : {'a', 'b', 'c'}) {
        const Apple id = letters.next();
        letters.push_back(letter);
        EXPECT_EQ(letters[id], letter);
    }
    std::vector<char> forwards, backwards;
    for (const Apple id : letters.ids()) forwards.push_back(letters[id]);
    for (const Apple id : letters.ids_backwards()) backwards.push_back(letters[id]);
    EXPECT_THAT(forwards, ElementsAre('a', 'b', 'c'));
    EXPECT_THAT(backwards, ElementsAre('c', 'b', 'a'));
}

}  // namespace
}  // namespace cascade::test
