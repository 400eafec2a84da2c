#pragma once
/// Reads XML files strictly: an unknown element or attribute, a missing one or a malformed number is an InputError
/// `file:line: <element attribute="text">: expected ...; remedy`.
///
///   const XmlElement cable = XmlElement::read_file(path, "cable");   // the root element, <cable>
///   cable.only({"law", "stiffness", "slack"}, {"run"});              // call first: any other name throws
///   const double k_e = cable.number("stiffness", "N/m", Sign::positive);
///   const double slack = cable.number_or("slack", 0.0, "m");         // slack="2 mm" is 0.002
///   const auto law = cable.choice<CableLaw>("law", {{"paper", CableLaw::paper}, {"linear", CableLaw::linear}});
///   for (const XmlElement& run : cable.children("run")) ...
///
/// Numbers are SI and finite. A text may end in " deg" if the unit is "rad", and in " mm" if the unit is "m". A unit of
/// "" is a pure number. Lists of attributes and elements are in the order of the file; comments are skipped.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tinyxml2 {
class XMLElement;
}

namespace halyard {

enum class Sign { any, non_negative, positive };

using XmlNames = std::vector<std::string>;

/// An element of a document; keeps the document alive. All failures are InputErrors.
class XmlElement {
 public:
  /// The root element of a file. Throws if the file cannot be read, is not well-formed or has another root.
  static XmlElement read_file(const std::filesystem::path& path, std::string_view root);
  /// The same for any root element; tag() gives its name.
  static XmlElement read_file(const std::filesystem::path& path);
  /// From text; messages name `source` in place of a file.
  static XmlElement parse(const std::string& xml, const std::string& source, std::string_view root);

  std::string tag() const;
  /// The file, as given.
  const std::string& source() const;

  /// Throws `file:line: <tag>: what`.
  [[noreturn]] void fail(const std::string& what) const;
  /// Throws `file:line: <tag attribute="text">: what`.
  [[noreturn]] void fail(std::string_view attribute, const std::string& what) const;

  /// Throws unless all attributes and child elements are among these and there is no text.
  void only(const XmlNames& attributes, const XmlNames& children = {}) const;
  /// As only(), but allows any attribute.
  void only_children(const XmlNames& children) const;

  bool has(std::string_view attribute) const;
  /// All attributes.
  std::vector<std::pair<std::string, std::string>> attributes() const;

  /// Required; not blank.
  std::string text(std::string_view attribute) const;
  std::string text_or(std::string_view attribute, const std::string& fallback) const;
  /// Required; the file has to be there. A relative path is relative to the folder of this file.
  std::filesystem::path path(std::string_view attribute) const;
  double number(std::string_view attribute, std::string_view unit, Sign sign = Sign::any) const;
  double number_or(std::string_view attribute, double fallback, std::string_view unit, Sign sign = Sign::any) const;
  /// Numbers separated by blanks: exactly `count` numbers, or, if count is 0, one or more. A suffix at the end applies
  /// to all of them: "0 0 90 deg".
  std::vector<double> numbers(std::string_view attribute, std::string_view unit, std::size_t count = 0) const;
  /// The element's own text, <gravity>-9.81 0 0</gravity>, as numbers; throws if it has attributes or children too.
  std::vector<double> text_numbers(std::string_view unit, std::size_t count = 0) const;
  /// A whole number, lower..upper.
  std::int64_t integer(std::string_view attribute, std::int64_t lower, std::int64_t upper) const;
  std::int64_t integer_or(std::string_view attribute, std::int64_t fallback, std::int64_t lower,
                          std::int64_t upper) const;
  /// "true" or "false".
  bool flag_or(std::string_view attribute, bool fallback) const;

  /// The value listed for the attribute's text; throws if the text is not listed.
  template <class E>
  E choice(std::string_view attribute, const std::vector<std::pair<std::string, E>>& values) const {
    XmlNames names;
    for (const auto& [name, value] : values) names.push_back(name);
    return values[index_of(attribute, names)].second;
  }
  template <class E>
  E choice_or(std::string_view attribute, E fallback, const std::vector<std::pair<std::string, E>>& values) const {
    return has(attribute) ? choice(attribute, values) : fallback;
  }

  std::vector<XmlElement> children() const;
  std::vector<XmlElement> children(std::string_view tag) const;
  /// The child with this tag; throws if there is none or more than one.
  XmlElement child(std::string_view tag) const;
  /// The child with this tag, if any; throws if there is more than one.
  std::optional<XmlElement> optional_child(std::string_view tag) const;

 private:
  struct Document;
  XmlElement(std::shared_ptr<const Document> document, const tinyxml2::XMLElement* element)
      : document_(std::move(document)), element_(element) {}

  static XmlElement root_of(const std::string& xml, const std::string& source);
  XmlElement expect_root(std::string_view root) const;
  std::size_t index_of(std::string_view attribute, const XmlNames& names) const;
  [[noreturn]] void fail_child(const tinyxml2::XMLElement* child, const XmlNames& known) const;
  [[noreturn]] void fail_missing(std::string_view attribute, const std::string& expected) const;

  std::shared_ptr<const Document> document_;
  const tinyxml2::XMLElement* element_;
};

/// The shortest text that reads back as the same double.
std::string exact_text(double value);

}  // namespace halyard
