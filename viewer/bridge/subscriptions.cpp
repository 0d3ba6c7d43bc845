#include "viewer/bridge/subscriptions.h"

#include <algorithm>
#include <set>

namespace tern {

void Subscriptions::keep_only(const std::vector<std::int64_t>& clients) {
  std::erase_if(by_page_, [&](const auto& entry) { return std::ranges::find(clients, entry.first) == clients.end(); });
}

LayersCommand Subscriptions::layers() const {
  LayersCommand all;
  for (const auto& [client, page] : by_page_) {
    all.hulls = all.hulls || page.layers.hulls;
    all.tracks = all.tracks || page.layers.tracks;
    all.planes = all.planes || page.layers.planes;
    all.search = all.search || page.layers.search;
  }
  return all;
}

std::vector<std::string> Subscriptions::series() const {
  std::set<std::string> all;
  for (const auto& [client, page] : by_page_) all.insert(page.series.begin(), page.series.end());
  std::vector<std::string> names(all.begin(), all.end());
  names.resize(std::min(names.size(), kMaxSeries));
  return names;
}

}  // namespace tern
