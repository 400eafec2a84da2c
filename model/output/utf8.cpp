#include "model/output/utf8.h"

#include <algorithm>
#include <cstdint>

namespace halyard {
namespace {

bool continues_character(unsigned char byte) { return (byte & 0xC0) == 0x80; }

/// Number of bytes of the UTF-8 character that the text starts with; 0 if it starts with none.
std::size_t size_of_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t size = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < size) return 0;
  std::uint32_t code = first & (0x7F >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if (!continues_character(byte(i))) return 0;
    code = code << 6 | (byte(i) & 0x3F);
  }
  constexpr std::uint32_t kLeast[] = {0x80, 0x800, 0x10000}, kLast = 0x10FFFF;  // of two, three and four bytes
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code >= kLeast[size - 2] && code <= kLast && !is_surrogate ? size : 0;
}

/// C0 but the line break, DEL, or C1.
bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return (first < 0x20 && first != '\n') || first == 0x7F;
  return first == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0;
}

}  // namespace

void for_each_character(std::string_view text, const std::function<void(std::string_view, bool)>& visit) {
  while (!text.empty()) {
    const std::size_t size = size_of_character(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(size, 1));
    visit(character, size > 0 && !is_control(character));
    text.remove_prefix(character.size());
  }
}

}  // namespace halyard
