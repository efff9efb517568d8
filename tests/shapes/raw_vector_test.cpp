#include <gtest/gtest.h>
#include <swept/shapes/raw_vector.h>

#include <cstdint>
#include <type_traits>

/// An array that makes room without filling it, and is a vector in all else.

namespace swept::test {
namespace {

/// Tells by how often values were made for it.
struct Counted {
    Counted() { ++made; }
    std::uint32_t value = 77;
    static inline int made = 0;
};
static_assert(std::is_trivially_copyable_v<Counted>);

TEST(RawVector, MakesNoValuesForWhatIsOnlyGivenRoom) {
    Counted::made = 0;
    RawVector<Counted> room(10);
    room.resize(1000);
    room.resize(3);
    room.resize(20);
    EXPECT_EQ(Counted::made, 0);
    EXPECT_EQ(room.size(), 20U);
}

TEST(RawVector, KeepsWhatItIsGiven) {
    Counted given;
    given.value = 4;
    RawVector<Counted> numbers(3, given);
    given.value = 5;
    numbers.push_back(given);
    numbers.emplace_back(given).value = 6;
    RawVector<Counted> copy = numbers;
    given.value = 7;
    copy.resize(5000, given);
    EXPECT_EQ(numbers.size(), 5U);
    EXPECT_EQ(copy[2].value, 4U);
    EXPECT_EQ(copy[3].value, 5U);
    EXPECT_EQ(copy[4].value, 6U);
    EXPECT_EQ(copy[5].value, 7U);
    EXPECT_EQ(copy.back().value, 7U);
    copy.resize(4);
    copy.resize(5000);  // moved elsewhere or not: what was kept is there
    EXPECT_EQ(copy[3].value, 5U);
    numbers.swap(copy);
    EXPECT_EQ(numbers.size(), 5000U);
    numbers.assign(2, given);
    EXPECT_EQ(numbers[1].value, 7U);
}

}  // namespace
}  // namespace swept::test
