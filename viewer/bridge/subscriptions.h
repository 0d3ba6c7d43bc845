// What pages want of that which is made only while someone looks.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "viewer/bridge/commands.h"

namespace tern {

/// Of all pages together.
class Subscriptions {
 public:
  void take(std::int64_t client, const LayersCommand& layers) { by_page_[client].layers = layers; }
  void take(std::int64_t client, const SeriesCommand& series) { by_page_[client].series = series.names; }
  /// @param clients  the pages that still look
  void keep_only(const std::vector<std::int64_t>& clients);

  [[nodiscard]] LayersCommand layers() const;
  /// Sorted, each once, at most kMaxSeries.
  [[nodiscard]] std::vector<std::string> series() const;

 private:
  struct Page {
    LayersCommand layers;
    std::vector<std::string> series;
  };
  std::map<std::int64_t, Page> by_page_;
};

}  // namespace tern
