#pragma once
/// Pieces of SVG that several pictures share.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace halyard::report {

enum class Anchor { start, middle, end };

/// Width of a usual letter.
inline constexpr double kSvgLetter = 6.6;

/// An attribute for letters so small that a long line of text fits into the space; empty if it fits anyway.
std::string fitted_size(std::string_view words, double space);
/// A line of text, escaped. turned: it reads upwards.
std::string svg_text(double x, double y, Anchor anchor, std::string_view words, std::string_view more = "",
                     bool turned = false);
/// Numbers beside an axis: "0.02", "3.16e-4". With three digits, or as many as it takes so that different numbers have
/// different texts.
std::vector<std::string> svg_numbers(std::span<const double> values);
/// The picture around its content.
std::string svg_document(double width, double height, const std::string& content);

}  // namespace halyard::report
