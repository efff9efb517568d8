#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include <swept/broadphase/aabb_tree.h>
#include <swept/broadphase/all_pairs.h>
#include <swept/broadphase/bvh.h>
#include <swept/broadphase/grid.h>
#include <swept/broadphase/proxy_table.h>
#include <swept/broadphase/quadtree.h>
#include <swept/broadphase/sort_and_sweep.h>
#include <swept/broadphase/table_broadphase.h>
#include <swept/broadphase/wide_bvh.h>
#include <swept/broadphase/wide_tree.h>
#include <swept/engine/containers/pair_table.h>
#include <swept/engine/containers/slot_pool.h>
#include <swept/engine/ids.h>
#include <swept/engine/state/parked_contacts.h>
#include <swept/shapes/listed_members.h>
#include <swept/solver/graph/island_finder.h>

/// Classes whose members are private list all of them: nobody else can count these, but what is listed fills the class.

namespace swept::test {
namespace {

/// What stands in a class for a member that was listed.
template <class Member>
struct StandsFor;
template <class T>
struct StandsFor<T&> {
    using Type = T;
};
template <class T>
struct StandsFor<LeftOut<T>> {
    using Type = std::conditional_t<std::is_const_v<T>, T*, T>;  // what is constant of one that is not: a reference
};

constexpr std::size_t roundedUp(std::size_t size, std::size_t alignment) {
    return (size + alignment - 1) / alignment * alignment;
}

/// Where members end that stand one after the other. @param begin  of the first
template <class Places, class... Members>
constexpr std::size_t endOf(std::size_t begin, const ListedAt<Places, Members...>*) {
    std::size_t end = begin;
    ((end = roundedUp(end, alignof(typename StandsFor<Members>::Type)) + sizeof(typename StandsFor<Members>::Type)),
     ...);
    return end;
}

/// Those of the bases, if any, are listed as one.
template <class T>
constexpr bool areAllListed(std::size_t begin = 0) {
    using Members = decltype(T::allMembers(std::declval<T&>()));
    return roundedUp(endOf(begin, static_cast<const Members*>(nullptr)), alignof(T)) == sizeof(T);
}

TEST(ListedMembers, AreAllThereAre) {
    EXPECT_TRUE((areAllListed<SlotPool<double, BodyId>>()));
    EXPECT_TRUE(areAllListed<PairTable>());
    EXPECT_TRUE(areAllListed<ParkedPairs<ContactPair>>());
    EXPECT_TRUE(areAllListed<IslandFinder>());
    EXPECT_TRUE(areAllListed<AabbTree>());
    EXPECT_TRUE(areAllListed<ProxyTable>());
    EXPECT_TRUE(areAllListed<TableBroadphase>(sizeof(void*))) << "behind the table of virtual functions";
    EXPECT_TRUE(areAllListed<AllPairs>());
    EXPECT_TRUE(areAllListed<SortAndSweep>());
    EXPECT_TRUE(areAllListed<Quadtree>());
    EXPECT_TRUE(areAllListed<Grid>());
    EXPECT_TRUE(areAllListed<Bvh>());
    EXPECT_TRUE(areAllListed<WideTree>());
    EXPECT_TRUE(areAllListed<WideBvh>());
}

}  // namespace
}  // namespace swept::test
