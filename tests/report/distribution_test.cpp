#include "report/distribution.h"

#include <gmock/gmock.h>

namespace skinforge {
namespace {

// Ranks of five values are 0 to 4, so p25 is the second, p05 lies a fifth of the way from the first to the
// second.
TEST(Distribution, ByHand) {
  const auto d = distribution_of({50, 10, 40, 20, 30});
  ASSERT_TRUE(d);
  EXPECT_EQ(d->count, 5);
  EXPECT_EQ(d->min, 10);
  EXPECT_EQ(d->mean, 30);
  EXPECT_DOUBLE_EQ(d->p05, 12);
  EXPECT_EQ(d->p25, 20);
  EXPECT_EQ(d->p50, 30);
  EXPECT_EQ(d->p75, 40);
  EXPECT_DOUBLE_EQ(d->p95, 48);
  EXPECT_EQ(d->max, 50);
}

TEST(Distribution, OneValueIsEverything) {
  const auto d = distribution_of({7});
  EXPECT_EQ(d->min, 7);
  EXPECT_EQ(d->p05, 7);
  EXPECT_EQ(d->p95, 7);
  EXPECT_EQ(d->mean, 7);
}

TEST(Distribution, NoValuesGiveNone) {
  EXPECT_FALSE(distribution_of({}));
}

// 0.1 + 0.2 + 0.3 rounds differently in another order; sorted first, it does not.
TEST(Distribution, OrderDoesNotMatter) {
  EXPECT_EQ(distribution_of({0.3, 0.2, 0.1})->mean, distribution_of({0.1, 0.2, 0.3})->mean);
}

}  // namespace
}  // namespace skinforge
