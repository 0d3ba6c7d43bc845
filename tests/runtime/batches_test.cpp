// BatchCollector hands on complete sets only.
#include "runtime/batches.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/world/track.h"

namespace tern {
namespace {

TrackSet batch(std::int64_t epoch, std::int64_t set, int index, int count) {
  TrackSet message;
  message.header.name = {epoch, set * 10 + index};
  message.batch = {set, index, count};
  return message;
}

TEST(BatchCollector, GivesASingleBatchAtOnce) {
  BatchCollector<TrackSet> collector;
  const auto set = collector.add(batch(1, 1, 0, 1));
  ASSERT_TRUE(set);
  EXPECT_EQ(set->size(), 1U);
}

RC_GTEST_PROP(BatchCollector, GivesTheSetInIndexOrderOnceWhateverTheOrderAndRepeatsOfArrival, ()) {
  const int count = *rc::gen::inRange(1, kMaxBatches + 1);
  std::vector<int> arrivals = *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, count));
  for (int i = 0; i < count; ++i) arrivals.push_back(i);
  BatchCollector<TrackSet> collector;
  std::vector<bool> seen(static_cast<std::size_t>(count));
  int missing = count;
  for (const int i : arrivals) {
    const auto set = collector.add(batch(1, 7, i, count));
    const bool is_new = !seen[static_cast<std::size_t>(i)];
    seen[static_cast<std::size_t>(i)] = true;
    if (is_new) --missing;
    RC_ASSERT(set.has_value() == (is_new && missing == 0));
    if (!set) continue;
    for (int k = 0; k < count; ++k) RC_ASSERT((*set)[static_cast<std::size_t>(k)].batch.index == k);
  }
  RC_ASSERT(collector.incomplete() == 0);
}

TEST(BatchCollector, ANewerSetReplacesAnUnfinishedOneAndCountsIt) {
  BatchCollector<TrackSet> collector;
  EXPECT_FALSE(collector.add(batch(1, 1, 0, 2)));
  EXPECT_FALSE(collector.add(batch(1, 2, 0, 2)));
  EXPECT_EQ(collector.incomplete(), 1);
  EXPECT_FALSE(collector.add(batch(1, 1, 1, 2))) << "the old set is gone";
  const auto set = collector.add(batch(1, 2, 1, 2));
  ASSERT_TRUE(set);
  EXPECT_EQ((*set)[1].batch.set, 2);
  EXPECT_EQ(collector.incomplete(), 1);
}

TEST(BatchCollector, CollectsTheSetsOfEachSenderByThemselves) {
  BatchCollector<TrackSet> collector;
  EXPECT_FALSE(collector.add(batch(1, 100, 0, 2)));
  EXPECT_TRUE(collector.add(batch(2, 1, 0, 1))) << "a smaller set number of a newer sender";
  EXPECT_TRUE(collector.add(batch(1, 100, 1, 2))) << "the older one is not forgotten";
  EXPECT_EQ(collector.incomplete(), 0);
}

TEST(BatchCollector, AFarSetNumberMutesNoLaterSet) {
  const auto at = [](UTime sent, std::int64_t set, std::int32_t count) {
    TrackSet message = batch(1, set, 0, count);
    message.header.utime = sent;
    return message;
  };
  BatchCollector<TrackSet> collector;
  EXPECT_TRUE(collector.add(at(UTime{100}, 7, 1)));
  EXPECT_FALSE(collector.add(at(UTime{110}, std::int64_t{1} << 58, 2))) << "half a set, far ahead";
  EXPECT_TRUE(collector.add(at(UTime{150}, 8, 1)));
  EXPECT_FALSE(collector.add(at(UTime{100}, 7, 1))) << "an old one that comes again";
}

TEST(BatchCollector, ForgedSendersPushOutOnlyTheOnesNotHeardLongest) {
  BatchCollector<TrackSet> collector;
  for (std::int64_t epoch = 2; epoch < 1'000; ++epoch) {
    EXPECT_FALSE(collector.add(batch(1, epoch, 0, 2)));
    EXPECT_FALSE(collector.add(batch(epoch, 5, 0, 2)));
    EXPECT_TRUE(collector.add(batch(1, epoch, 1, 2)));
  }
}

TEST(BatchCollector, DropsABatchThatContradictsTheSetsCount) {
  BatchCollector<TrackSet> collector;
  EXPECT_FALSE(collector.add(batch(1, 1, 0, 2)));
  EXPECT_FALSE(collector.add(batch(1, 1, 1, 3))) << "the first batch said 2";
  EXPECT_TRUE(collector.add(batch(1, 1, 1, 2)));
}

}  // namespace
}  // namespace tern
