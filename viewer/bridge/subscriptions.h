// The optional layers and chart series that pages subscribe to; they are computed only while a page shows them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "viewer/bridge/commands.h"

namespace tern {

/// The union of all pages' subscriptions.
class Subscriptions {
 public:
  void take(std::int64_t client, const LayersCommand& layers) { by_page_[client].layers = layers; }
  void take(std::int64_t client, const SeriesCommand& series) { by_page_[client].series = series.names; }
  /// Drops the subscriptions of disconnected pages. @param clients  the connected pages
  void keep_only(const std::vector<std::int64_t>& clients);

  [[nodiscard]] LayersCommand layers() const;
  /// Returns the series, sorted and unique, at most kMaxSeries.
  [[nodiscard]] std::vector<std::string> series() const;

 private:
  struct Page {
    LayersCommand layers;
    std::vector<std::string> series;
  };
  std::map<std::int64_t, Page> by_page_;
};

}  // namespace tern
