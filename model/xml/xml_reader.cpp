#include "model/xml/xml_reader.h"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "model/input/cell_text.h"
#include "model/input/text_file.h"
#include "model/input_error.h"
#include "model/name_list.h"

namespace halyard {

struct XmlElement::Document {
  tinyxml2::XMLDocument xml;
  std::string source;
};

namespace {

std::string one_of(const char* what, const XmlNames& names) {
  const std::string expected = names.empty() ? "none" : names.size() == 1 ? names.front() : "one of " + listed(names);
  return std::string("unknown ") + what + "; expected " + expected;
}

bool contains(const XmlNames& names, std::string_view name) { return std::ranges::find(names, name) != names.end(); }

struct Suffix {
  std::string_view unit, name;
  double si;
};
constexpr std::array kSuffixes = {Suffix{"rad", "deg", std::numbers::pi / 180}, Suffix{"m", "mm", 1e-3}};

/// Numbers between blanks, with an optional suffix as the last word; nothing if the text is anything else.
std::optional<std::vector<double>> parse_numbers(std::string_view text, std::string_view unit) {
  std::vector<std::string_view> words;
  for (std::string_view rest = trim(text); !rest.empty();) {
    words.push_back(rest.substr(0, rest.find_first_of(" \t\r\n")));
    rest = trim(rest.substr(words.back().size()));
  }
  double si = 1;
  for (const Suffix& suffix : kSuffixes) {
    if (words.empty() || suffix.unit != unit || words.back() != suffix.name) continue;
    si = suffix.si;
    words.pop_back();
  }
  std::vector<double> values;
  for (const std::string_view word : words) {
    const std::optional<double> value = parse_number(word);
    if (!value) return std::nullopt;
    values.push_back(si * *value);
  }
  return values;
}

/// "a number in N/m, with nothing behind it, such as 1.5e3"
std::string expected_number(std::string_view unit) {
  std::string expected = "a number" + std::string(unit.empty() ? "" : " in ").append(unit);
  for (const Suffix& suffix : kSuffixes)
    if (suffix.unit == unit)
      return expected.append(", or one with ")
          .append(suffix.name)
          .append(" behind it, such as 1.5 ")
          .append(suffix.name);
  return expected + ", with nothing behind it, such as 1.5e3";
}

std::string expected_numbers(std::string_view unit, std::size_t count) {
  std::string expected = count == 0 ? "numbers" : std::to_string(count) + " numbers";
  if (!unit.empty()) expected.append(" in ").append(unit);
  expected += " with blanks between them";
  for (const Suffix& suffix : kSuffixes) {
    if (suffix.unit == unit) expected.append("; a last word ").append(suffix.name).append(" is of all of them");
  }
  return expected;
}

/// tinyxml2's "XML_ERROR_MISMATCHED_ELEMENT" as "mismatched element".
std::string reason(const tinyxml2::XMLDocument& xml) {
  std::string text = xml.ErrorName();
  if (text.starts_with("XML_ERROR_")) text.erase(0, 10);
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return c == '_' ? ' ' : std::tolower(c); });
  return text;
}

}  // namespace

XmlElement XmlElement::root_of(const std::string& xml, const std::string& source) {
  if (trim(xml).empty()) throw InputError(source + ": is empty; give an XML file in UTF-8");
  if (xml.find('\0') != xml.npos) throw InputError(source + ": is not text; give an XML file in UTF-8");
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  std::string_view start = trim(xml);
  if (start.starts_with(kByteOrderMark)) start = trim(start.substr(kByteOrderMark.size()));
  if (!start.starts_with('<'))
    throw InputError(source + ":1: is no XML: it does not begin with '<'; give the path of an XML file");
  auto document = std::make_shared<Document>();
  document->source = source;
  if (document->xml.Parse(xml.data(), xml.size()) != tinyxml2::XML_SUCCESS) {
    throw InputError(source + ":" + std::to_string(std::max(1, document->xml.ErrorLineNum())) +
                     ": is not well-formed XML (" + reason(document->xml) +
                     "); correct the tags and attributes near this line: each tag closed, each attribute once, " +
                     "in quotes");
  }
  const tinyxml2::XMLElement* root = document->xml.RootElement();
  if (!root) throw InputError(source + ":1: has no XML element; give an XML file");
  const XmlElement element(std::move(document), root);
  for (const tinyxml2::XMLNode* next = root->NextSibling(); next; next = next->NextSibling()) {
    if (next->ToElement() || next->ToText()) {
      throw InputError(source + ":" + std::to_string(next->GetLineNum()) + ": expected nothing after </" +
                       shortened(element.tag()) + ">; an XML file has one root element");
    }
  }
  return element;
}

XmlElement XmlElement::expect_root(std::string_view root) const {
  if (tag() != root) fail("expected a file whose root element is <" + std::string(root) + ">; give such a file");
  return *this;
}

XmlElement XmlElement::read_file(const std::filesystem::path& path) {
  return root_of(read_text_file(path, {.name = "an XML file", .if_too_large = "give the path of an XML file"}),
                 path.string());
}

XmlElement XmlElement::read_file(const std::filesystem::path& path, std::string_view root) {
  return read_file(path).expect_root(root);
}

XmlElement XmlElement::parse(const std::string& xml, const std::string& source, std::string_view root) {
  return root_of(xml, source).expect_root(root);
}

std::string XmlElement::tag() const { return element_->Name(); }

const std::string& XmlElement::source() const { return document_->source; }

void XmlElement::fail(const std::string& what) const {
  throw InputError(source() + ":" + std::to_string(element_->GetLineNum()) + ": <" + shortened(tag()) + ">: " + what);
}

void XmlElement::fail(std::string_view attribute, const std::string& what) const {
  const tinyxml2::XMLAttribute* found = element_->FindAttribute(std::string(attribute).c_str());
  if (!found) fail(what);
  throw InputError(source() + ":" + std::to_string(found->GetLineNum()) + ": <" + shortened(tag()) + " " +
                   shortened(attribute) + "=\"" + shortened(found->Value()) + "\">: " + what);
}

void XmlElement::fail_missing(std::string_view attribute, const std::string& expected) const {
  fail("attribute " + std::string(attribute) + " is missing; expected " + expected);
}

void XmlElement::fail_child(const tinyxml2::XMLElement* child, const XmlNames& known) const {
  XmlElement(document_, child).fail(one_of("element", known) + " inside <" + shortened(tag()) + ">");
}

void XmlElement::only(const XmlNames& attributes, const XmlNames& children) const {
  for (const auto* attribute = element_->FirstAttribute(); attribute; attribute = attribute->Next()) {
    if (!contains(attributes, attribute->Name())) fail(attribute->Name(), one_of("attribute", attributes));
  }
  only_children(children);
}

void XmlElement::only_children(const XmlNames& children) const {
  for (const tinyxml2::XMLNode* node = element_->FirstChild(); node; node = node->NextSibling()) {
    if (const tinyxml2::XMLElement* element = node->ToElement()) {
      if (!contains(children, element->Name())) fail_child(element, children);
    } else if (node->ToText() && !trim(node->Value()).empty()) {
      fail("text " + in_quotes(trim(node->Value())) + ": expected none here; values are attributes, name=\"value\"");
    }
  }
}

bool XmlElement::has(std::string_view attribute) const {
  return element_->FindAttribute(std::string(attribute).c_str()) != nullptr;
}

std::vector<std::pair<std::string, std::string>> XmlElement::attributes() const {
  std::vector<std::pair<std::string, std::string>> all;
  for (const auto* attribute = element_->FirstAttribute(); attribute; attribute = attribute->Next()) {
    all.emplace_back(attribute->Name(), attribute->Value());
  }
  return all;
}

std::string XmlElement::text(std::string_view attribute) const {
  const char* found = element_->Attribute(std::string(attribute).c_str());
  if (!found) fail_missing(attribute, "a text");
  if (trim(found).empty()) fail(attribute, "expected a text that is not blank");
  const auto is_control = [](unsigned char c) {
    return (c < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7f;
  };
  if (std::ranges::any_of(std::string_view(found), is_control))
    fail(attribute, "expected a text without control characters; remove them");
  return found;
}

std::string XmlElement::text_or(std::string_view attribute, const std::string& fallback) const {
  return has(attribute) ? text(attribute) : fallback;
}

std::filesystem::path XmlElement::path(std::string_view attribute) const {
  const std::filesystem::path path = std::filesystem::path(source()).parent_path() / text(attribute);
  std::error_code unknown;
  const bool is_folder = std::filesystem::is_directory(path, unknown);
  if (is_folder || !std::filesystem::exists(path, unknown)) {
    fail(attribute, shortened(path.string()) + (is_folder ? ": is a directory" : ": no such file") +
                        "; correct the path, which is relative to this file's folder");
  }
  return path;
}

double XmlElement::number(std::string_view attribute, std::string_view unit, Sign sign) const {
  const char* found = element_->Attribute(std::string(attribute).c_str());
  if (!found) fail_missing(attribute, expected_number(unit));
  const auto values = parse_numbers(found, unit);
  if (!values || values->size() != 1) fail(attribute, "expected " + expected_number(unit));
  const double value = values->front();
  if (sign == Sign::positive && !(value > 0)) fail(attribute, "expected a number greater than 0");
  if (sign == Sign::non_negative && !(value >= 0)) fail(attribute, "expected a number of at least 0");
  return value;
}

double XmlElement::number_or(std::string_view attribute, double fallback, std::string_view unit, Sign sign) const {
  return has(attribute) ? number(attribute, unit, sign) : fallback;
}

std::vector<double> XmlElement::numbers(std::string_view attribute, std::string_view unit, std::size_t count) const {
  const char* found = element_->Attribute(std::string(attribute).c_str());
  if (!found) fail_missing(attribute, expected_numbers(unit, count));
  auto values = parse_numbers(found, unit);
  if (!values || values->empty() || (count != 0 && values->size() != count)) {
    fail(attribute, "expected " + expected_numbers(unit, count));
  }
  return *std::move(values);
}

std::vector<double> XmlElement::text_numbers(std::string_view unit, std::size_t count) const {
  std::string text;
  for (const tinyxml2::XMLNode* node = element_->FirstChild(); node; node = node->NextSibling()) {
    if (node->ToText()) text.append(" ").append(node->Value());
    if (const tinyxml2::XMLElement* element = node->ToElement()) fail_child(element, {});
  }
  if (const auto* attribute = element_->FirstAttribute()) fail(attribute->Name(), one_of("attribute", {}));
  auto values = parse_numbers(text, unit);
  if (!values || values->empty() || (count != 0 && values->size() != count)) {
    fail("text " + in_quotes(trim(text)) + ": expected " + expected_numbers(unit, count));
  }
  return *std::move(values);
}

std::int64_t XmlElement::integer(std::string_view attribute, std::int64_t lower, std::int64_t upper) const {
  const std::string expected = "a whole number from " + std::to_string(lower) + " to " + std::to_string(upper);
  const char* found = element_->Attribute(std::string(attribute).c_str());
  if (!found) fail_missing(attribute, expected);
  const std::string_view text = trim(found);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < lower || value > upper) {
    fail(attribute, "expected " + expected);
  }
  return value;
}

std::int64_t XmlElement::integer_or(std::string_view attribute, std::int64_t fallback, std::int64_t lower,
                                    std::int64_t upper) const {
  return has(attribute) ? integer(attribute, lower, upper) : fallback;
}

bool XmlElement::flag_or(std::string_view attribute, bool fallback) const {
  return choice_or<bool>(attribute, fallback, {{"true", true}, {"false", false}});
}

std::size_t XmlElement::index_of(std::string_view attribute, const XmlNames& names) const {
  const char* found = element_->Attribute(std::string(attribute).c_str());
  if (!found) fail_missing(attribute, "one of " + listed(names));
  const auto name = std::ranges::find(names, std::string(trim(found)));
  if (name == names.end()) fail(attribute, "expected one of " + listed(names));
  return name - names.begin();
}

std::vector<XmlElement> XmlElement::children() const {
  std::vector<XmlElement> all;
  for (const auto* child = element_->FirstChildElement(); child; child = child->NextSiblingElement()) {
    all.push_back(XmlElement(document_, child));
  }
  return all;
}

std::vector<XmlElement> XmlElement::children(std::string_view tag) const {
  std::vector<XmlElement> all = children();
  std::erase_if(all, [&](const XmlElement& child) { return child.tag() != tag; });
  return all;
}

XmlElement XmlElement::child(std::string_view tag) const {
  const std::optional<XmlElement> found = optional_child(tag);
  if (!found) fail("element <" + std::string(tag) + "> is missing; add it");
  return *found;
}

std::optional<XmlElement> XmlElement::optional_child(std::string_view tag) const {
  const std::vector<XmlElement> found = children(tag);
  if (found.size() > 1) found[1].fail("stands twice inside <" + shortened(this->tag()) + ">; give it once");
  if (found.empty()) return std::nullopt;
  return found.front();
}

std::string exact_text(double value) {
  std::array<char, 32> buffer;
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

}  // namespace halyard
