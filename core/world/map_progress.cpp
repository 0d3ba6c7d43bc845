#include "core/world/map_progress.h"

#include <fmt/format.h>

namespace tern {

void MapProgress::add(const MapChunk& chunk) {
  if (chunk.version != version_ || static_cast<int>(have_.size()) != chunk.count) {
    version_ = chunk.version;
    have_.assign(static_cast<std::size_t>(chunk.count), false);
    chunks_ = 0;
  }
  if (chunk.index >= chunk.count || have_[idx(chunk.index)]) return;
  have_[idx(chunk.index)] = true;
  ++chunks_;
}

std::string MapProgress::missing() const {
  if (rotation() <= kMapSilence) return "a semantic map";
  return fmt::format("a semantic map ({} of {} chunks, all take up to {:.0f} s)", chunks_, have_.size(),
                     rotation().seconds());
}

}  // namespace tern
