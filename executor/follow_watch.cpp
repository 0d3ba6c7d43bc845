#include "executor/follow_watch.h"

#include <utility>

#include "core/world/flyable.h"

namespace tern {
namespace {

bool has_departed(const TrackedState& s, const Vec3& off) {
  const bool turns = s.tube.isZero(0.0) && ((s.measured.v - s.committed.v).cwiseAbs().maxCoeff() > kJoinTolerance ||
                                            (s.measured.a - s.committed.a).cwiseAbs().maxCoeff() > kJoinTolerance);
  return turns || ((off - s.tube).array() > kJoinTolerance).any();
}

}  // namespace

FollowWatch::Judgement FollowWatch::judge(const TrackedState& state, UTime received) {
  const Vec3 off = (state.measured.p - state.committed.p).cwiseAbs();
  Judgement judgement;
  judgement.error = persistent_.add(off, received);
  const Vec3 excess = off - state.tube, before = std::exchange(excess_, excess);
  const bool is_off = judgement.error.maxCoeff() > kRejoinBeyond;
  const auto answer = [&](Following row) {
    judgement.answer = row;
    return judgement;
  };
  if (off.maxCoeff() > kRejoinBeyond && !is_off) return answer(Following::Unsure);
  if (state.after_silence && has_departed(state, off)) return answer(Following::Departed);
  if (!state.follows && state.reports_following) return answer(Following::OldMessages);
  if (!state.follows) return answer(is_off ? Following::Carried : Following::Held);
  judgement.outside = (excess.cwiseMin(before).array() > kMinError).any();
  judgement.leaves = !std::exchange(outside_, judgement.outside) && judgement.outside;
  if (judgement.leaves) ++exits_;
  if ((judgement.error - state.tube).maxCoeff() > kRejoinBeyond) return answer(Following::Lost);
  return answer(judgement.outside ? Following::Outside : Following::Inside);
}

}  // namespace tern
