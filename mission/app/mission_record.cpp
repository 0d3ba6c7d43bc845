#include "mission/app/mission_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/files.h"

namespace tern::mission {
namespace {

using Json = nlohmann::ordered_json;

const char* to_word(Stand stand) {
  switch (stand) {
    case Stand::Waiting: return "waiting";
    case Stand::Flying: return "flying";
    case Stand::Staying: return "staying";
    case Stand::Paused: return "paused";
    case Stand::Done: return "done";
    case Stand::Failed: return "failed";
  }
  return "unknown";
}

std::int64_t count_reached(const Progress& progress) {
  return std::count_if(progress.reached().begin(), progress.reached().end(),
                       [](const auto& at) { return at.has_value(); });
}

Json to_json(const Progress& progress) {
  const Mission& mission = progress.mission();
  Json json{
      {"mission", mission.file}, {"state", to_word(progress.stand())},       {"text", progress.text()},
      {"step", progress.step()}, {"steps_reached", count_reached(progress)}, {"steps_flown_again", progress.repeats()}};
  for (std::size_t k = 0; k < mission.steps.size(); ++k) {
    const Step& step = mission.steps[k];
    const auto& at = progress.reached()[k];
    json["steps"].push_back({{"name", step.name},
                             {"item", step.item},
                             {"position", {step.position.x(), step.position.y(), step.position.z()}},
                             {"reached_us", at ? Json(at->us) : Json()}});
  }
  return json;
}

/// Bytes of a file's name that are not UTF-8 are replaced.
std::string to_text(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

/// Replaces a file, so that a reader finds the old content or the new one.
bool replace(const std::string& path, const std::string& text) {
  const std::string fresh = path + ".new";
  return write_text(fresh, text) && std::rename(fresh.c_str(), path.c_str()) == 0;
}

}  // namespace

std::string to_text(const Progress& progress) {
  const Mission& mission = progress.mission();
  std::string text = fmt::format("Mission {}: {} of {} steps reached, {}\n", mission.file, count_reached(progress),
                                 mission.steps.size(), progress.text());
  std::optional<UTime> before;
  for (std::size_t k = 0; k < mission.steps.size(); ++k) {
    const auto& at = progress.reached()[k];
    std::string when = "not reached";
    if (at) when = before ? fmt::format("reached, {:.1f} s later", (*at - *before).seconds()) : "reached";
    if (at) before = at;
    text += fmt::format("  {:3} {:24} {}\n", k + 1, mission.steps[k].name, when);
  }
  return text;
}

bool MissionRecord::write(const Progress& progress) const {
  if (folder_.empty()) return true;
  return replace(folder_ + "/mission.json", to_text(to_json(progress))) &&
         replace(folder_ + "/mission.txt", to_text(progress));
}

std::optional<Remembered> MissionRecord::read(const Mission& mission) const try {
  if (folder_.empty()) return std::nullopt;
  const Json json = Json::parse(read_text(folder_ + "/mission.json"), nullptr, false);
  if (!json.is_object() || json.at("mission") != mission.file) return std::nullopt;
  Remembered remembered;
  remembered.step = json.at("step").get<int>();
  remembered.is_paused = json.at("state") == "paused";
  for (const Stand end : {Stand::Done, Stand::Failed}) {
    if (json.at("state") == to_word(end)) remembered.ended = end;
  }
  remembered.text = json.at("text").get<std::string>();
  for (const Json& step : json.at("steps")) {
    const Json& at = step.at("reached_us");
    remembered.reached.push_back(at.is_null() ? std::nullopt : std::optional(UTime{at.get<std::int64_t>()}));
  }
  const bool is_step = remembered.step >= 0 && remembered.step < static_cast<int>(mission.steps.size());
  if (!is_step || remembered.reached.size() != mission.steps.size()) return std::nullopt;
  return remembered;
} catch (const Json::exception&) {
  return std::nullopt;
}

void MissionRecord::forget() const {
  if (folder_.empty()) return;
  for (const char* name : {"/mission.json", "/mission.txt", "/uploaded.json"}) std::remove((folder_ + name).c_str());
}

bool MissionRecord::write_upload(const std::vector<Step>& steps) const {
  if (folder_.empty()) return true;
  Json json = Json::array();
  for (const Step& step : steps) {
    json.push_back({{"name", step.name},
                    {"item", step.item},
                    {"action", static_cast<int>(step.action)},
                    {"position", {step.position.x(), step.position.y(), step.position.z()}},
                    {"radius", step.radius},
                    {"hold_s", step.hold_s},
                    {"speed", step.speed}});
  }
  return replace(folder_ + "/uploaded.json", to_text(json));
}

std::optional<std::vector<Step>> MissionRecord::read_upload() const try {
  if (folder_.empty()) return std::nullopt;
  std::vector<Step> steps;
  const Json json = Json::parse(read_text(folder_ + "/uploaded.json"), nullptr, false);
  if (!json.is_array() || json.empty()) return std::nullopt;
  for (const Json& step : json) {
    const Json& p = step.at("position");
    steps.push_back({step.at("name").get<std::string>(), step.at("item").get<int>(),
                     step.at("action").get<int>() == 0 ? Action::Pass : Action::Stop,
                     Vec3(p.at(0).get<double>(), p.at(1).get<double>(), p.at(2).get<double>()),
                     step.at("radius").get<double>(), step.at("hold_s").get<double>(), 0, step.value("speed", 0.0)});
  }
  return steps;
} catch (const Json::exception&) {
  return std::nullopt;
}

Result<void> MissionRecord::write_fences(const std::vector<mavlink::MissionItemInt>& items) const {
  if (folder_.empty()) {
    if (items.empty()) return {};
    return fail("fences are taken only with --record FOLDER, so that a restart has them");
  }
  Json json = Json::array();
  for (const mavlink::MissionItemInt& item : items) {
    Json params = Json::array();
    for (const float param : item.param) params.push_back(std::isfinite(param) ? Json(param) : Json());
    json.push_back({{"command", item.command},
                    {"frame", item.frame},
                    {"params", params},
                    {"x", item.x},
                    {"y", item.y},
                    {"z", std::isfinite(item.z) ? Json(item.z) : Json()}});
  }
  if (!replace(folder_ + "/fences.json", to_text(json))) return fail("the fences cannot be recorded");
  return {};
}

Result<std::vector<mavlink::MissionItemInt>> MissionRecord::read_fences() const try {
  const std::string path = folder_ + "/fences.json";
  std::vector<mavlink::MissionItemInt> items;
  if (folder_.empty() || !std::filesystem::exists(path)) return items;
  const Json json = Json::parse(read_text(path));
  const auto number = [](const Json& value) {
    return value.is_null() ? std::numeric_limits<float>::quiet_NaN() : value.get<float>();
  };
  for (const Json& each : json) {
    mavlink::MissionItemInt item;
    item.seq = static_cast<std::uint16_t>(items.size());
    item.command = each.at("command").get<std::uint16_t>();
    item.frame = each.at("frame").get<std::uint8_t>();
    for (std::size_t k = 0; k < item.param.size(); ++k) item.param[k] = number(each.at("params").at(k));
    item.x = each.at("x").get<std::int32_t>();
    item.y = each.at("y").get<std::int32_t>();
    item.z = number(each.at("z"));
    items.push_back(item);
  }
  return items;
} catch (const Json::exception& e) {
  return fail(e.what());
}

}  // namespace tern::mission
