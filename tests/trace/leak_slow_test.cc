#include <gtest/gtest.h>

#include "tests/trace/closed_rooms.h"

namespace lambert {
namespace {

constexpr int64_t kRays = 10000000;

TEST(LeakSlow, ClosedConvexRoomsLoseNoneOfTenMillionRays) {
  for (const auto& [name, patches] : ConvexRooms()) ExpectNoLoss(patches, kRays, name);
}

TEST(LeakSlow, ATurnedFineCubeLosesNoneOfTenMillionRays) {
  ExpectNoLoss(Turned(ConvexRooms()[1].patches), kRays, "turned fine cube");
}

TEST(LeakSlow, ATurnedCornellBoxClosedInFrontLosesNoneOfTenMillionRays) {
  ExpectNoLoss(Turned(ClosedCornell(7)), kRays, "Cornell box, turned");
}

}  // namespace
}  // namespace lambert
