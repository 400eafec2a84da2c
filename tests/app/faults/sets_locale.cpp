// Preloaded into a program, gives it the locale of the environment, as a program that embeds halyard may. Ends it if
// that locale has no decimal comma: the test would show nothing.
#include <clocale>
#include <cstdlib>

namespace {

[[gnu::constructor]] void set_locale() {
  if (!std::setlocale(LC_ALL, "") || *std::localeconv()->decimal_point != ',') std::abort();
}

}  // namespace
