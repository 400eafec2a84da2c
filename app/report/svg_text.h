#pragma once
/// Pieces of SVG that several pictures share.

#include <string>
#include <string_view>

namespace halyard::report {

enum class Anchor { start, middle, end };

/// A line of text; &, < and > are escaped. turned: it reads upwards.
std::string svg_text(double x, double y, Anchor anchor, std::string_view words, std::string_view more = "",
                     bool turned = false);
/// A number beside an axis, with three digits: "0.02", "3.16e-4".
std::string svg_number(double value);
/// The picture around its content.
std::string svg_document(double width, double height, const std::string& content);

}  // namespace halyard::report
