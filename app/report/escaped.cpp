#include "app/report/escaped.h"

#include "model/output/utf8.h"

namespace halyard::report {
namespace {

std::string_view entity_of(std::string_view character) {
  switch (character[0]) {
    case '&': return "&amp;";
    case '<': return "&lt;";
    case '>': return "&gt;";
    case '"': return "&quot;";
    case '\'': return "&#39;";
    default: return character;
  }
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string safe;
  for_each_character(text, [&](std::string_view character, bool is_printable) {
    safe += is_printable ? entity_of(character) : "\uFFFD";
  });
  return safe;
}

}  // namespace halyard::report
