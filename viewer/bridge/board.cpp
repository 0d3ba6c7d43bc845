#include "viewer/bridge/board.h"

#include <fmt/format.h>

#include <utility>

#include "core/base/types.h"

namespace tern {

const char* to_string(Topic topic) {
  constexpr std::array<const char*, kTopics> kNames = {"session", "player", "state",  "truth",    "tracks", "request",
                                                       "plan",    "timing", "hulls",  "tracked",  "search", "map",
                                                       "health",  "goal",   "result", "chart",    "path",   "fields",
                                                       "events",  "ghost",  "views",  "estimate", "sight"};
  return kNames.at(idx(topic));
}

void Board::post(Topic topic, std::string json) {
  auto text = std::make_shared<const std::string>(std::move(json));
  const std::lock_guard lock(mutex_);
  Entry& entry = entries_[idx(topic)];
  if (entry.json && *entry.json == *text) return;
  ++entry.version;
  entry.json = std::move(text);
}

std::string Board::take(Reader& reader) const {
  std::array<std::shared_ptr<const std::string>, kTopics> news;
  bool any = false;
  {
    const std::lock_guard lock(mutex_);
    for (std::size_t k = 0; k < kTopics; ++k) {
      const Entry& entry = entries_[k];
      if (entry.version == reader.taken[k]) continue;
      if (reader.frame > 0) reader.dropped += entry.version - reader.taken[k] - 1;
      reader.taken[k] = entry.version;
      news[k] = entry.json;
      any = true;
    }
  }
  if (!any) return {};
  std::string frame = fmt::format("{{\"frame\":{},\"dropped\":{}", ++reader.frame, reader.dropped);
  for (std::size_t k = 0; k < kTopics; ++k) {
    if (news[k]) frame += fmt::format(",\"{}\":{}", to_string(static_cast<Topic>(k)), *news[k]);
  }
  return frame + "}";
}

}  // namespace tern
