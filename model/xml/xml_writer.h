#pragma once
/// Writes XML files with halyard's numbers: each reads back to the last bit, in every locale.

#include <tinyxml2.h>

#include <initializer_list>
#include <span>
#include <string>

#include "model/xml/xml_reader.h"

namespace halyard {

class XmlWriter {
 public:
  /// <?xml version="1.0"?>
  void declare() { printer_.PushHeader(false, true); }
  void open(const char* tag) { printer_.OpenElement(tag); }
  void close() { printer_.CloseElement(); }
  void attribute(const char* name, const std::string& text) { printer_.PushAttribute(name, text.c_str()); }
  void attribute(const char* name, double value) { attribute(name, exact_text(value)); }
  /// Numbers with blanks between.
  void attribute(const char* name, std::span<const double> values) { attribute(name, listed(values)); }
  void text(std::span<const double> values) { printer_.PushText(listed(values).c_str()); }

  struct Number {
    const char* name;
    double value;
  };
  /// An element that has these attributes alone.
  void element(const char* tag, std::initializer_list<Number> numbers) {
    open(tag);
    for (const Number& number : numbers) attribute(number.name, number.value);
    close();
  }
  std::string result() const { return printer_.CStr(); }

 private:
  static std::string listed(std::span<const double> values) {
    std::string text;
    for (const double value : values) text.append(text.empty() ? "" : " ").append(exact_text(value));
    return text;
  }

  tinyxml2::XMLPrinter printer_;
};

}  // namespace halyard
