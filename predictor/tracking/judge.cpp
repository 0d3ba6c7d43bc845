#include "predictor/tracking/judge.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "predictor/models/axis_filter.h"

namespace tern {
namespace {

// Pools of model scores.
constexpr std::size_t kSlow = 0, kFast = 1, kAll = 2;
// A track that was so fast, m/s, within some seconds, belongs to the second pool.
constexpr double kFastSpeed = 2.0;
constexpr double kSpeedMemory = 3.0;
// By its models' weights at this horizon a track has its class.
constexpr std::size_t kClassHorizon = 2;
// A new track's predictions are scored at its first detections of these numbers, and once it is no longer young; then
// once in kScorePeriod.
constexpr std::array kFirstScored{1, 2, 3, 5, 8};

// A thing whose nearest detection is so much farther off than what is judged, m, is no better explanation of it.
constexpr double kFarApart = 2.0;
constexpr bool is_judged(double ahead_s) {
  return std::find(kJudgedAhead.begin(), kJudgedAhead.end(), ahead_s) != kJudgedAhead.end();
}
static_assert(is_judged(kSpeedSpan) && std::all_of(kLearntAhead.begin(), kLearntAhead.end(), is_judged));

// The truth at a time from detections near it, or between two neighbours.
template <typename Sample>
std::optional<Sample> truth_at(const std::vector<Sample>& samples, UTime at) {
  std::size_t first = 0;
  while (first < samples.size() && (at - samples[first].at).seconds() > kSmoothed) ++first;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  std::size_t last = first, before = 0;
  const auto row = [&](std::size_t k) -> Eigen::Vector3d {
    const double t = (samples[k].at - at).seconds() / kSmoothed;
    return {1.0, t, t * t};
  };
  for (; last < samples.size() && (samples[last].at - at).seconds() <= kSmoothed; ++last) {
    normal += row(last) * row(last).transpose();
    before += samples[last].at <= at ? 1U : 0U;
  }
  Sample truth{at, Vec3::Zero(), Vec3::Zero()};
  if (last - first >= 4 && before > 0 && before < last - first) {
    const Eigen::Vector3d solved = normal.inverse().col(0);
    for (std::size_t k = first; k < last; ++k) {
      const double c = solved.dot(row(k));
      truth.z += c * samples[k].z;
      truth.r += c * c * samples[k].r;
    }
    return truth;
  }
  const auto after = std::find_if(samples.begin(), samples.end(), [&](const Sample& s) { return s.at >= at; });
  if (after == samples.begin() || after == samples.end()) return std::nullopt;
  const Sample& a = *(after - 1);
  const double gap = (after->at - a.at).seconds();
  if (gap > kWidestGap) return std::nullopt;
  const double u = (at - a.at).seconds() / gap;
  truth.z = (1.0 - u) * a.z + u * after->z;
  truth.r = (1.0 - u) * (1.0 - u) * a.r + u * u * after->r;
  return truth;
}

// Where it was detected nearest to that time.
template <typename Sample>
const Sample& nearest(const std::vector<Sample>& samples, UTime at) {
  const auto after =
      std::lower_bound(samples.begin(), samples.end() - 1, at, [](const Sample& s, UTime t) { return s.at < t; });
  return after == samples.begin() || after->at - at < at - (after - 1)->at ? *after : *(after - 1);
}

// The truth's own noise adds its variance to what is seen of an error.
template <typename Sample>
Vec3 error_of(const Mixed& said, const Sample& truth) {
  return ((truth.z - said.centre).cwiseAbs2() - truth.r).cwiseMax(0.0).cwiseSqrt();
}

template <typename Sample>
double margin_for(const Mixed& said, const Sample& truth, double ahead_s) {
  return containing_margin(error_of(said, truth), said.deviation, band_of(ahead_s), ahead_s);
}

// Between the times at which something was said, in a straight line. @pre kJudgedAhead reaches `ahead_s`
Mixed said_at(const std::array<Mixed, kJudgedAhead.size()>& said, double ahead_s) {
  const auto next = std::lower_bound(kJudgedAhead.begin() + 1, kJudgedAhead.end() - 1, ahead_s);
  const auto k = static_cast<std::size_t>(next - kJudgedAhead.begin());
  const double u = (ahead_s - kJudgedAhead[k - 1]) / (kJudgedAhead[k] - kJudgedAhead[k - 1]);
  Mixed between;
  between.centre = said[k - 1].centre + u * (said[k].centre - said[k - 1].centre);
  between.deviation = said[k - 1].deviation + u * (said[k].deviation - said[k - 1].deviation);
  return between;
}

UTime judged_at(UTime at, std::size_t k) { return at + Duration::from_seconds(kJudgedAhead[k]); }

}  // namespace

Judge::Judge(double confidence, bool learns) : learns_(learns), calibration_(confidence) {
  pools_.fill(ModelScores(-kFarthestBehind));  // the learnt model is trusted once it has proved better
  const BankStep none = bank_step(0.0);
  for (std::size_t k = 0; k < looks_.size(); ++k) looks_[k] = bank_look(bank_step(kJudgedAhead[k]), none);
}

void Judge::take(UTime at, const std::vector<SeenTrack>& seen, const std::set<std::int64_t>& tracks) {
  judged_.clear();
  for (const SeenTrack& track : seen) {
    History& history = histories_[track.id];
    if (history.samples.empty() || history.born != track.born) {
      history = History{};
      history.born = track.born;
    }
    follow(track, at, history);
    score(track.id, history);
  }
  calibration_.set_pace(pace());
  calibration_.refresh();
  if (learns_) look_anew();
  for (const SeenTrack& track : seen) {
    if (!track.rests) issue(track, at, histories_[track.id]);
  }
  std::erase_if(histories_, [&](const auto& entry) {
    const auto& [id, history] = entry;
    if (tracks.contains(id)) return false;
    for (const Issue& issue : history.issues) judged_.push_back(issue.judged);
    return true;
  });
}

void Judge::look_anew() {
  learnt_.refresh();
  for (std::size_t group = 0; group < kLearntGroups; ++group) {
    for (std::size_t k = 0; k < kJudgedAhead.size(); ++k) {
      learnt_looks_[group][k] = learnt_.at(kJudgedAhead[k], group);
    }
  }
}

void Judge::follow(const SeenTrack& track, UTime at, History& history) {
  if (!history.samples.empty()) {
    history.fastest *= std::exp(-(at - history.samples.back().at).seconds() / kSpeedMemory);
  }
  if ((at - track.born).seconds() >= kYoungAge) {
    history.fastest = std::max(history.fastest, track.bank->lead().velocity().norm());
  }
  history.samples.push_back({at, track.position, track.variance.cwiseMax(kLeastVariance)});
  std::erase_if(history.samples, [&](const Sample& s) { return (at - s.at).seconds() > 2.0 * kSmoothed + kWidestGap; });
}

void Judge::issue(const SeenTrack& track, UTime at, History& history) const {
  const bool first = std::find(kFirstScored.begin(), kFirstScored.end(), track.detections) != kFirstScored.end();
  const bool grew_up = (history.issued - track.born).seconds() < kYoungAge && (at - track.born).seconds() >= kYoungAge;
  const bool is_due = history.issues.empty() || (at - history.issued).seconds() >= kScorePeriod;
  if (!first && !grew_up && !is_due) return;
  history.issued = at;
  Issue& issue = history.issues.emplace_back();
  history.due.push_back(judged_at(at, 0));
  issue.at = at;
  issue.from = track.position;
  issue.pace = calibration_.pace();
  issue.pool = pool_of(track, at, history.fastest);
  issue.score = -kModelSigmas;
  issue.half.fill(Vec3::Zero());
  if (learns_) {
    issue.learnt_from = learnt_from(*track.bank);
    issue.group = learnt_group((at - track.born).seconds());
  }
  issue.learnt_to = learnt_to(issue.group);
  const HorizonWeights all = model_weights(pools_[issue.pool], history.own, issue.group, issue.learnt_to);
  issue.judged.kind = class_of(track, at, all);
  issue.margins = calibration_.margins(issue.judged.kind);
  for (std::size_t k = 0; k < looks_.size(); ++k) {
    FilterLook learnt{issue.from, Vec3::Zero(), Vec3::Zero()};  // not listened to where there is no group
    if (issue.group) learnt = said_by(learnt_looks_[*issue.group][k], issue.learnt_from);
    issue.said[k] = mixed(*track.bank, looks_[k], learnt, weights_at(all, kJudgedAhead[k]));
    const auto scored = std::find(kScoredAhead.begin(), kScoredAhead.end(), kJudgedAhead[k]);
    if (scored == kScoredAhead.end()) continue;
    PerCandidate<Said>& said = issue.models_said[static_cast<std::size_t>(scored - kScoredAhead.begin())];
    for (std::size_t j = 0; j < kModels; ++j) {
      const FilterLook ahead = track.bank->of(j).at(looks_[k][j]);
      said[j] = {ahead.position, ahead.variance};
    }
    said[kLearnt] = {learnt.position, learnt.variance};
  }
}

void Judge::score(std::int64_t id, History& history) {
  const UTime settled = history.samples.back().at - Duration::from_seconds(kSmoothed);
  for (std::size_t i = 0; i < history.issues.size();) {
    if (history.due[i] > settled) {
      ++i;
      continue;
    }
    Issue& issue = history.issues[i];
    while (issue.next < kJudgedAhead.size() && judged_at(issue.at, issue.next) <= settled) {
      const std::optional<Sample> truth = truth_at(history.samples, judged_at(issue.at, issue.next));
      if (!truth) break;
      score(issue, *truth, id, history);
      ++issue.next;
    }
    // Over: judged to its end, or nobody saw what came.
    const bool is_over = issue.next == kJudgedAhead.size() || judged_at(issue.at, issue.next) <= settled;
    if (!is_over) {
      history.due[i++] = judged_at(issue.at, issue.next);
      continue;
    }
    judged_.push_back(issue.judged);
    history.issues.erase(history.issues.begin() + static_cast<std::ptrdiff_t>(i));
    history.due.erase(history.due.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

void Judge::score(Issue& issue, const Sample& truth, std::int64_t id, History& history) {
  const std::size_t k = issue.next, band = band_of(kJudgedAhead[k]);
  const Mixed& said = issue.said[k];
  if (kJudgedAhead[k] == kSpeedSpan) see_speed((truth.z - issue.from) / kSpeedSpan, id);
  const double own = margin_for(said, truth, kJudgedAhead[k]);
  const double score = own > 0.0 ? std::min(own, exchanged_margin(issue, truth, history)) : own;
  issue.score = std::max(issue.score, score);
  if (score == own) learn(issue, truth);
  const Vec3 error = error_of(said, truth);
  for (std::size_t level = 0; level < issue.margins.size(); ++level) {
    Vec3& half = issue.half[level];
    half = half.cwiseMax(promised_half(said.deviation, issue.margins[level], kJudgedAhead[k]));
    const bool is_outside = (error.array() > half.array()).any() && score > issue.margins[level][band];
    issue.broken[level] = issue.broken[level] || is_outside;
  }
  if (kJudgedAhead[k] < kBandEnds[band]) return;
  const auto final_score = static_cast<float>(issue.score);
  calibration_.add(issue.judged.kind, band, final_score, issue.broken, issue.pace);
  issue.judged.scores[band] = final_score;
  issue.judged.bands = band + 1;
  issue.score = -kModelSigmas;

  const auto scored = std::find(kScoredAhead.begin(), kScoredAhead.end(), kJudgedAhead[k]);
  if (scored == kScoredAhead.end() || score < own) return;  // the models said nothing of another thing
  const auto h = static_cast<std::size_t>(scored - kScoredAhead.begin());
  PerCandidate<double> scores{};
  for (std::size_t j = 0; j < scores.size(); ++j) {
    const Said& model = issue.models_said[h][j];
    for (int i = 0; i < 3; ++i) {
      scores[j] += predictive_score(truth.z[i] - model.centre[i], model.variance[i] + truth.r[i]);
    }
  }
  // Who sleeps is not judged (Y. Freund et al., "Using and combining predictors that specialize", STOC 1997).
  const std::optional<std::size_t> group = kScoredAhead[h] <= issue.learnt_to ? issue.group : std::nullopt;
  history.own.add(h, scores, group, kOwnForgetting);
  pools_[kAll].add(h, scores, group, kPoolForgetting);
  if (issue.pool != kAll) pools_[issue.pool].add(h, scores, group, kPoolForgetting);
}

void Judge::learn(const Issue& issue, const Sample& truth) {
  const auto at = std::find(kLearntAhead.begin(), kLearntAhead.end(), kJudgedAhead[issue.next]);
  if (!issue.group || at == kLearntAhead.end()) return;
  learnt_.learn(idx(at - kLearntAhead.begin()), *issue.group, issue.learnt_from, truth.z, truth.r, worth(*at));
}

void Judge::see_speed(const Vec3& velocity, std::int64_t id) {
  fastest_ = std::max(fastest_, velocity.cwiseAbs().maxCoeff());
  top_speed_ = std::max(top_speed_, velocity.norm());
  if (velocity.norm() > kStill && movers_.size() < kMoversOfAWorld) movers_.insert(id);
}

WorldPace Judge::pace() const {
  return movers_.size() >= kMoversOfAWorld && top_speed_ < kSlowSpeed ? WorldPace::Slow : WorldPace::Any;
}

double Judge::exchanged_margin(const Issue& issue, const Sample& truth, const History& own) const {
  const Vec3 far = (truth.z - issue.said[issue.next].centre).cwiseAbs().array() + kFarApart;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [id, other] : histories_) {
    if (&other == &own || other.samples.empty()) continue;
    const Vec3 apart = (nearest(other.samples, truth.at).z - issue.said[issue.next].centre).cwiseAbs();
    if ((apart.array() > far.array()).any()) continue;
    const std::optional<Sample> there = truth_at(other.samples, truth.at);
    if (!there) continue;
    const double here = margin_for(issue.said[issue.next], *there, kJudgedAhead[issue.next]);
    if (here >= least) continue;
    if (other.born > issue.at) {
      least = here;
      continue;
    }
    const auto is_nearer = [&](const Issue& a, const Issue& b) {
      return std::abs((a.at - issue.at).us) < std::abs((b.at - issue.at).us);
    };
    const auto said = std::min_element(other.issues.begin(), other.issues.end(), is_nearer);
    if (said == other.issues.end() || std::abs((said->at - issue.at).seconds()) > kScorePeriod) continue;
    const double ahead_s = (truth.at - said->at).seconds();
    if (ahead_s < kJudgedAhead.front() || ahead_s > kJudgedAhead.back()) continue;  // it said nothing of that time
    least = std::min(least, std::max(here, margin_for(said_at(said->said, ahead_s), truth, ahead_s)));
  }
  return least;
}

const Judge::History* Judge::known(std::int64_t id, UTime born) const {
  const auto found = histories_.find(id);
  return found == histories_.end() || found->second.born != born ? nullptr : &found->second;
}

std::size_t Judge::pool_of(const SeenTrack& track, UTime at, double fastest) {
  if ((at - track.born).seconds() < kYoungAge) return kAll;
  return std::max(fastest, track.bank->lead().velocity().norm()) >= kFastSpeed ? kFast : kSlow;
}

Judge::Verdict Judge::verdict(const SeenTrack& track, UTime last_seen) const {
  const History* history = known(track.id, track.born);
  const ModelScores own = history == nullptr ? ModelScores{} : history->own;
  const double fastest = history == nullptr ? 0.0 : history->fastest;
  Verdict verdict;
  verdict.group = learnt_group((last_seen - track.born).seconds());
  verdict.weights =
      model_weights(pools_[pool_of(track, last_seen, fastest)], own, verdict.group, learnt_to(verdict.group));
  verdict.kind = class_of(track, last_seen, verdict.weights);
  return verdict;
}

TrackClass Judge::class_of(const SeenTrack& track, UTime now, const HorizonWeights& weights) {
  if (track.detections <= 1) return TrackClass::New;
  const double age = (now - track.born).seconds();
  if (age < kYoungAge) return TrackClass::Young;
  const PerCandidate<double> at = weights_at(weights, kScoredAhead[kClassHorizon]);
  const auto weight = [first_of = at.begin()](std::size_t first, std::size_t end) {
    return std::accumulate(first_of + static_cast<std::ptrdiff_t>(first), first_of + static_cast<std::ptrdiff_t>(end),
                           0.0);
  };
  const double steady = weight(0, kSteadyModels), calm = weight(kSteadyModels, kCalmModels);
  const bool old = age >= kGrownAge;
  if (at[kLearnt] > 0.5) return TrackClass::Learnt;
  if (steady > 0.5) return old ? TrackClass::SteadyOld : TrackClass::SteadyGrown;
  if (calm > 0.5 * (1.0 - steady)) return old ? TrackClass::CalmOld : TrackClass::CalmGrown;
  return old ? TrackClass::LivelyOld : TrackClass::LivelyGrown;
}

}  // namespace tern
