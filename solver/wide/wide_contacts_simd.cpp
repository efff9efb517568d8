// Compiled once per instruction set: foreach_target.h reads this file again for each.
#include "../contacts/contact_constraint.h"
#include "wide_contacts.h"
#include "wide_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wide/wide_contacts_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#if HWY_TARGET == HWY_SCALAR || (defined(SWEPT_F64) && !HWY_HAVE_FLOAT64)
namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {
const ContactKernels* kernelsForContacts() { return nullptr; }  // machines without registers to speak of: one by one
}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
#else

HWY_BEFORE_NAMESPACE();
#undef SWEPT_GROUP_BYTES
#define SWEPT_GROUP_BYTES 16
#include "wide_contact_group.inc"
#undef SWEPT_GROUP_BYTES
#define SWEPT_GROUP_BYTES 32
#include "wide_contact_group.inc"
#undef SWEPT_GROUP_BYTES
#define SWEPT_GROUP_BYTES 64
#include "wide_contact_group.inc"

namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {

using namespace SWEPT_GROUP;

template <std::size_t kPoints>
void prepare(std::span<WideContact<kPoints> > blocks) {
    for (WideContact<kPoints>& block : blocks) {
        for (std::size_t i = 0; i < block.lanes; i += kGroup) {
            prepareGroup(block, i);
            if constexpr (kPoints == 2) { prepareShared(block, i); }
        }
    }
}

template <std::size_t kPoints>
void warmStart(std::span<WideContact<kPoints> > blocks, const SolverBodies& bodies) {
    for (WideContact<kPoints>& block : blocks) {
        for (std::size_t i = 0; i < block.lanes; i += kGroup) { ContactGroup<kPoints>(block, i, bodies).warmStart(); }
    }
}

template <std::size_t kPoints>
void bounce(std::span<WideContact<kPoints> > blocks, const SolverBodies& bodies, const ContactPass& pass) {
    for (WideContact<kPoints>& block : blocks) {
        if (!(block.mostRestitution > pass.leastRestitution)) { continue; }
        for (std::size_t i = 0; i < block.lanes; i += kGroup) { ContactGroup<kPoints>(block, i, bodies).bounce(pass); }
    }
}

/// What is left of a block is solved in registers that are no wider than it asks for, since each lane has its bodies
/// fetched, in use or not: most blocks of a small scene are not full.
template <std::size_t kPoints>
void solve(std::span<WideContact<kPoints> > blocks, const SolverBodies& bodies, const ContactPass& pass) {
    for (WideContact<kPoints>& block : blocks) {
        for (std::size_t i = 0; i < block.lanes; i += kGroup) {
            const std::size_t left = block.lanes - i;
            if (GroupsOf16::kGroup < kGroup && left <= GroupsOf16::kGroup) {
                GroupsOf16::solveGroup(block, i, bodies, pass);
            } else if (GroupsOf32::kGroup < kGroup && left <= GroupsOf32::kGroup) {
                GroupsOf32::solveGroup(block, i, bodies, pass);
            } else {
                solveGroup(block, i, bodies, pass);
            }
        }
    }
}

const ContactKernels* kernelsForContacts() {
    static const ContactKernels kKernels = {hwy::TargetName(HWY_TARGET),
                                            prepare<1>,
                                            prepare<2>,
                                            warmStart<1>,
                                            warmStart<2>,
                                            bounce<1>,
                                            bounce<2>,
                                            solve<1>,
                                            solve<2>};
    return &kKernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace swept::inline SWEPT_PRECISION {

namespace {
HWY_EXPORT(kernelsForContacts);
}

const ContactKernels* contactKernels() { return HWY_DYNAMIC_DISPATCH(kernelsForContacts)(); }

}  // namespace swept::inline SWEPT_PRECISION
#endif
