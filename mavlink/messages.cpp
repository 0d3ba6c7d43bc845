#include "mavlink/messages.h"

namespace tern::mavlink {
namespace {

template <class... M>
std::optional<MessageForm> find(std::uint32_t id, std::type_identity<std::tuple<M...>>) {
  std::optional<MessageForm> form;
  ((M::kId == id
        ? (void)(form = MessageForm{M::kId, M::kCrcExtra, M::kMinLength, static_cast<std::uint8_t>(length_of<M>())})
        : void()),
   ...);
  return form;
}

}  // namespace

std::string printable(std::string words) {
  if (words.ends_with('\t')) words.pop_back();
  for (char& c : words) {
    if (c < ' ' || c > '~') c = '?';
  }
  return words;
}

std::optional<MessageForm> form_of(std::uint32_t id) { return find(id, std::type_identity<AllMessages>{}); }

}  // namespace tern::mavlink
