#pragma once
/// What the declarations of several commands share. Only for the files that declare commands: CLI11 takes seconds to
/// compile.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include "evaluation/run/tried_effects.h"
#include "model/column_map.h"
#include "model/input/cell_text.h"
#include "model/input_error.h"

namespace halyard {

/// A command is an add_..._command function: it declares options that write into a struct and says what runs. The
/// struct lives in the callback.
using Run = std::function<void()>;

inline void finish(CLI::App& command, Run run) { command.callback(std::move(run)); }

/// For commands that read models: their effects may be a user's own.
inline void add_effects_option(CLI::App& command) {
  command
      .add_option_function<std::vector<std::string>>(
          "--effects",
          [](const std::vector<std::string>& modules) {
            for (const std::string& module : modules) load_tried_effects(module);
          },
          "module with your own effects; may be repeated")
      ->type_name("MODULE.so")
      ->take_all()
      ->allow_extra_args(false);
}

/// What an option that is a number may be.
struct NumberRange {
  double least = 0, most = std::numeric_limits<double>::max();
  bool above_least = false;  ///< without `least` itself
};

/// CLI11 would convert the text by the C locale, which may have decimal commas.
template <class Number>
CLI::Option* add_real(CLI::App& command, const std::string& name, Number& value, const std::string& description) {
  CLI::Option* option = command.add_option_function<std::string>(
      name, [&value](const std::string& text) { value = parse_number(text).value(); }, description);
  if constexpr (std::is_same_v<Number, double>)
    option->default_function([&value] { return fmt::format("{:g}", value); });
  return option;
}

/// CLI11 would read "010" as 8.
template <class Number>
CLI::Option* add_whole(CLI::App& command, const std::string& name, Number& value, const std::string& description) {
  return command
      .add_option_function<std::string>(
          name,
          [&value, name](const std::string& text) {
            if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc{})
              throw CLI::ConversionError(text, name);
          },
          description)
      ->default_function([&value] { return fmt::format("{}", value); });
}

/// For every option that is a number. CLI11's own checks let NaN pass.
template <class Number>
CLI::Option* add_number(CLI::App& command, const std::string& name, Number& value, const NumberRange& range,
                        const std::string& description) {
  constexpr bool whole = std::is_integral_v<Number>;
  const auto fault = [range](const std::string& text) -> std::string {
    const std::optional<double> number = parse_number(text);
    if (number && (*number > range.least || (*number == range.least && !range.above_least)) && *number <= range.most &&
        (!whole || text.find_first_not_of("0123456789") == text.npos))
      return "";
    return in_quotes(text) + ": expected a " + (whole ? "whole " : "finite ") + "number, " +
           (range.above_least ? "above " : "at least ") + fmt::format("{:g}", range.least) +
           (range.most < std::numeric_limits<double>::max() ? fmt::format(", at most {:g}", range.most) : "");
  };
  CLI::Option* option = nullptr;
  if constexpr (whole) option = add_whole(command, name, value, description);
  else option = add_real(command, name, value, description);
  return option->check(fault)->type_name("N");
}

}  // namespace halyard
