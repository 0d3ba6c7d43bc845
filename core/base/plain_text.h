// Text that is safe to print, to put into JSON and to send: bytes of files and of others are made so.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tern {

/// True if the text is UTF-8 without control characters (U+0000 … U+001F, U+007F) except tab and newline. Such a text
/// is safe to print and to put into JSON. O(size).
bool is_plain_text(std::string_view text);

/// Returns the text with '?' in place of each byte that belongs to no plain character. A text of more than `most_bytes`
/// is cut between two characters. The result is plain; a plain text that is short enough is returned as it is. O(size).
std::string plain_text(std::string_view text, std::size_t most_bytes = std::string_view::npos);

}  // namespace tern
