#include "semantic_mapper/app/map_file_parts.h"

namespace tern {

std::optional<std::vector<std::uint8_t>> MapFileParts::add(const MapFile& part) {
  const bool is_other = part.header.name.sender_epoch_us != sender_ || part.at != at_ || part.origin != origin_ ||
                        static_cast<std::size_t>(part.parts) != parts_.size();
  if (is_other) {
    sender_ = part.header.name.sender_epoch_us;
    at_ = part.at;
    origin_ = part.origin;
    missing_ = static_cast<std::size_t>(part.parts);
    parts_.assign(missing_, std::nullopt);
  }
  auto& place = parts_[idx(part.part)];
  if (missing_ == 0 || place) return std::nullopt;
  place = part.bytes;
  if (--missing_ > 0) return std::nullopt;
  std::vector<std::uint8_t> whole;
  for (auto& bytes : parts_) {
    whole.insert(whole.end(), bytes->begin(), bytes->end());
    bytes.reset();
  }
  return whole;
}

}  // namespace tern
