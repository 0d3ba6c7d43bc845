#include "tools/audit/contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tools/audit/pairing.h"

namespace tern::audit {
namespace {

std::optional<PredictionAtContact> prediction_at_contact(const Track& track, const ObstacleHistory& truth,
                                                         UTime made_at, UTime at) {
  PredictionAtContact predicted{0.0, 0.0, true};
  UTime seen = made_at;
  follow(track, truth, std::max(made_at, track.motion.start), at, [&](const RequiredAlpha& n) {
    const Vec3 out = n.alpha - track.alpha[n.piece];
    Eigen::Index worst = 0;
    predicted.covered = predicted.covered && out.maxCoeff(&worst) <= kOutTolerance;
    predicted.needed_m = std::max(0.0, n.alpha[worst]);
    predicted.alpha_m = track.alpha[n.piece][worst];
    seen = n.at;
  });
  if (at - seen > kUnknownFor) return std::nullopt;
  return predicted;
}

void see_sets(const FlightRecord& record, Contact& contact) {
  const auto truth = record.truth.find(contact.obstacle);
  if (truth == record.truth.end()) return;
  Pairing pairing(record);
  std::optional<UTime> first, last;
  struct NewestSet {
    const Track* track = nullptr;  ///< null: it had no track in that set
    UTime made_at;
  };
  std::array<NewestSet, kBeforeContact.size()> newest;  ///< made at least that long before the contact
  for (const auto& [name, set] : record.predictions) {
    if (set.made_at > contact.at) continue;
    const auto& pairs = pairing.pair(set);
    const auto speaks = [&](const Track& t) {
      const auto pair = pairs.find(t.id);
      return pair != pairs.end() && pair->second.obstacle == contact.obstacle;
    };
    const auto track = std::find_if(set.tracks.begin(), set.tracks.end(), speaks);
    for (std::size_t k = 0; k < kBeforeContact.size(); ++k) {
      if ((contact.at - set.made_at).seconds() < kBeforeContact[k]) continue;
      newest[k] = {track == set.tracks.end() ? nullptr : &*track, set.made_at};
    }
    if (track == set.tracks.end()) continue;
    if (!last || set.made_at - *last > kForgottenAfter) first = set.made_at;
    last = set.made_at;
  }
  for (std::size_t k = 0; k < newest.size(); ++k) {
    const auto [track, made_at] = newest[k];
    if (track != nullptr) contact.predicted[k] = prediction_at_contact(*track, truth->second, made_at, contact.at);
  }
  if (last && contact.at - *last <= kForgottenAfter) contact.in_predictions_s = (contact.at - *first).seconds();
}

}  // namespace

Contact contact_at(const FlightRecord& record, UTime at, std::int64_t obstacle) {
  Contact contact;
  contact.at = at;
  contact.obstacle = obstacle;
  const auto after = std::ranges::upper_bound(record.states, at, {}, &UavState::at);
  if (after != record.states.begin()) contact.speed_mps = (after - 1)->motion.v.norm();
  see_sets(record, contact);
  for (const Plan& plan : record.plans) {
    const HorizonRequest* request = record.request(plan.inputs.request);
    if (request == nullptr || request->t_s > at || !claims_confidence(plan)) continue;
    contact.confidence = plan.confidence;
    contact.confident_s = (at - request->t_s).seconds();
  }
  return contact;
}

std::string to_text(const Contact& contact, const FlightRecord& record) {
  std::string text = fmt::format("{} was touched at {:.3f} s, by the vehicle at {:.2f} m/s. ",
                                 record.name_of(contact.obstacle), record.seconds(contact.at), contact.speed_mps);
  text.front() = 'O';
  text += contact.in_predictions_s
              ? fmt::format("It had been in PREDICTIONS for {:.2f} s.\n", *contact.in_predictions_s)
              : std::string("It was not in PREDICTIONS.\n");
  for (std::size_t k = 0; k < kBeforeContact.size(); ++k) {
    text += fmt::format("  {} s before ", kBeforeContact[k]);
    const auto& predicted = contact.predicted[k];
    text += predicted ? fmt::format("alpha was {:.2f} m, and {:.2f} m were needed: {}.\n", predicted->alpha_m,
                                    predicted->needed_m, predicted->covered ? "covered" : "missed")
                      : std::string("it was not predicted.\n");
  }
  text += contact.confidence ? fmt::format("  The last plan with a confidence ({}) began {:.2f} s before.\n",
                                           *contact.confidence, *contact.confident_s)
                             : std::string("  No earlier plan had a confidence.\n");
  return text;
}

nlohmann::json to_json(const Contact& contact, const FlightRecord& record) {
  nlohmann::json json = {{"time_s", record.seconds(contact.at)},
                         {"obstacle", contact.obstacle},
                         {"name", record.name_of(contact.obstacle)},
                         {"speed_mps", contact.speed_mps},
                         {"text", to_text(contact, record)}};
  if (contact.in_predictions_s) json["in_predictions_s"] = *contact.in_predictions_s;
  if (contact.confidence)
    json["last_confidence"] = *contact.confidence, json["last_confidence_s"] = *contact.confident_s;
  json["promised"] = nlohmann::json::array();
  for (std::size_t k = 0; k < kBeforeContact.size(); ++k) {
    if (!contact.predicted[k]) continue;
    const PredictionAtContact& predicted = *contact.predicted[k];
    json["promised"].push_back({{"before_s", kBeforeContact[k]},
                                {"needed_m", predicted.needed_m},
                                {"alpha_m", predicted.alpha_m},
                                {"kept", predicted.covered}});
  }
  return json;
}

}  // namespace tern::audit
