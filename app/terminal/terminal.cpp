#include "app/terminal/terminal.h"

#include <algorithm>
#include <cstdio>

#include "model/output/utf8.h"

namespace halyard {
namespace {

bool continues_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }

}  // namespace

std::string without_controls(std::string_view text) {
  std::string shown;
  for_each_character(text,
                     [&](std::string_view character, bool is_printable) { shown += is_printable ? character : "?"; });
  return shown;
}

std::string one_message(std::string_view text) {
  std::string line = without_controls(text);
  std::ranges::replace(line, '\n', ' ');
  if (line.size() <= kMostOfMessage) return line;
  constexpr std::string_view kGap = " ... ";
  constexpr std::size_t kEnd = 600, kStart = kMostOfMessage - kEnd - kGap.size();
  // Not within a character.
  std::size_t start = kStart, end = line.size() - kEnd;
  while (continues_character(line[start])) --start;
  while (continues_character(line[end])) ++end;
  return line.substr(0, start).append(kGap).append(line.substr(end));
}

void tell(std::string_view text) {
  std::fprintf(stderr, "%s\n", one_message(text).c_str());
  std::fflush(stderr);
}

void write_out(std::string_view text) {
  const std::string shown = without_controls(text);
  std::fwrite(shown.data(), 1, shown.size(), stdout);
}

}  // namespace halyard
