#include "model/output/number_text.h"

#include <array>
#include <charconv>

namespace halyard {
namespace {

std::string written(double value, std::chars_format format, int digits) {
  std::array<char, 400> buffer;  // the largest double has 309 digits before the point
  return {buffer.begin(), std::to_chars(buffer.begin(), buffer.end(), value, format, digits).ptr};
}

/// The value itself where its text is beyond the largest double.
double read_back(const std::string& text, double value) {
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace

std::string with_digits(double value, int digits) { return written(value, std::chars_format::general, digits); }

std::string with_decimals(double value, int decimals) { return written(value, std::chars_format::fixed, decimals); }

double rounded_to_digits(double value, int digits) { return read_back(with_digits(value, digits), value); }

double rounded_to_decimals(double value, int decimals) { return read_back(with_decimals(value, decimals), value); }

}  // namespace halyard
