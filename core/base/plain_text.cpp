#include "core/base/plain_text.h"

#include <algorithm>

namespace tern {
namespace {

/// Returns the length of the UTF-8 sequence that starts with `lead`; 0 if none does.
std::size_t sequence_length(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead < 0xE0) return 2;
  if (lead >= 0xE0 && lead < 0xF0) return 3;
  if (lead >= 0xF0 && lead < 0xF5) return 4;
  return 0;
}

/// The second byte rules out overlong forms, surrogates and code points beyond U+10FFFF.
bool second_byte_legal(unsigned char lead, unsigned char second) {
  switch (lead) {
    case 0xE0: return second >= 0xA0;
    case 0xED: return second < 0xA0;
    case 0xF0: return second >= 0x90;
    case 0xF4: return second < 0x90;
    default: return true;
  }
}

bool is_control(unsigned char c) { return (c < 0x20 && c != '\t' && c != '\n') || c == 0x7F; }

/// Returns the length of the plain character at the start of a text; 0 if there is none. @pre the text is not empty
std::size_t plain_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::size_t length = sequence_length(lead);
  if (length == 0 || length > text.size() || is_control(lead)) return 0;
  for (const char c : text.substr(1, length - 1)) {
    if ((static_cast<unsigned char>(c) & 0xC0U) != 0x80U) return 0;
  }
  if (length > 1 && !second_byte_legal(lead, static_cast<unsigned char>(text[1]))) return 0;
  return length;
}

}  // namespace

bool is_plain_text(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = plain_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string plain_text(std::string_view text, std::size_t most_bytes) {
  std::string plain;
  while (!text.empty()) {
    const std::size_t length = plain_length(text);
    const std::string_view character = length == 0 ? "?" : text.substr(0, length);
    if (plain.size() + character.size() > most_bytes) break;
    plain += character;
    text.remove_prefix(std::max(length, std::size_t{1}));
  }
  return plain;
}

}  // namespace tern
