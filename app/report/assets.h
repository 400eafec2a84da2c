#pragma once

#include <string_view>

/// Files that the build copies into the program, see CMakeLists.txt. Constants: safe to use at any time.
namespace halyard::report::assets {

extern const std::string_view chart_js;  ///< Chart.js, which defines the global Chart; MIT licence, notice included
extern const std::string_view page_css;
extern const std::string_view page_js;  ///< draws each chart's JSON

}  // namespace halyard::report::assets
