#include <algorithm>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "model/model_file.h"
#include "model/xml/arm_words.h"
#include "model/xml/xml_reader.h"
#include "model/xml/xml_writer.h"
#include "transmission/arm_fields.h"

namespace halyard {
namespace {

using Joint = JointParameters<double>;

/// The attributes of an element that have a joint's fields of that part.
class FieldWriter {
 public:
  FieldWriter(XmlWriter& xml, std::string_view part, Drive drive) : xml_(xml), part_(part), drive_(drive) {}

  template <class Value>
  void operator()(const ArmField& field, const Value& value) {
    if (field.part_at(drive_) != part_ || !field.exists_at(drive_)) return;
    const std::string name(field.name);
    if constexpr (std::is_same_v<Value, double>) {
      if (value == 0 && name.ends_with("_noise")) return;  // not stated
      xml_.attribute(name.c_str(), zero_known_ ? exact_text(value) : kUnknownZero);
      zero_known_ = true;
    } else if constexpr (std::is_same_v<Value, bool>) {
      zero_known_ = value;  // the offset follows
    } else if constexpr (std::is_enum_v<Value>) {
      xml_.attribute(name.c_str(), word_for(value));
    } else {
      std::vector<double> entries;
      for_each_entry([&](double entry) { entries.push_back(entry); }, value);
      xml_.attribute(name.c_str(), entries);
    }
  }

 private:
  XmlWriter& xml_;
  std::string_view part_;
  Drive drive_;
  bool zero_known_ = true;
};

void write_fields(XmlWriter& xml, const char* part, const Joint& j) {
  xml.open(part);
  for_each_joint_field(FieldWriter(xml, part, j.drive), j);
  xml.close();
}

void write_drive(XmlWriter& xml, const Joint& j, int k, const ControllerParameters& controller) {
  write_fields(xml, "motor", j);
  write_fields(xml, j.drive == Drive::rigid ? "rigid" : "cable", j);
  for (int inboard = 0; inboard < k; ++inboard) {
    if (j.coupling[inboard] == 0) continue;
    xml.element("coupling", {{"joint", inboard + 1.0}, {"coefficient", j.coupling[inboard]}});
  }
  xml.element("controller", {{"kp", controller.kp}, {"kd", controller.kd}, {"torque_limit", controller.torque_limit}});
}

void write_joint(XmlWriter& xml, const Joint& j, int k, const JointDescription& description) {
  xml.open("joint");
  xml.attribute("name", description.name);
  for_each_joint_field(FieldWriter(xml, "", j.drive), j);
  write_fields(xml, "frame", j);
  write_fields(xml, "link", j);
  if (j.drive != Drive::none) write_drive(xml, j, k, description.controller);
  write_fields(xml, "friction", j);
  write_fields(xml, "encoders", j);
  xml.element("range", {{"lower", description.lower}, {"upper", description.upper}, {"home", description.home}});
  xml.open("tolerances");
  for_each_tolerance(
      [&](const char* name, double Tolerances::*member) { xml.attribute(name, description.tolerances.*member); });
  xml.close();
  xml.close();
}

void write_arm_fields(XmlWriter& xml, const ArmParameters<double>& nominal) {
  const auto write = [&](const ArmField& field, const auto& value) {
    if constexpr (std::is_array_v<std::remove_reference_t<decltype(value)>>) {
      const std::string part(field.part), name(field.name);
      xml.open(part.c_str());  // the printer keeps the pointer until the element is closed
      if (name.empty()) xml.text(value);
      else xml.attribute(name.c_str(), value);
      xml.close();
    }
  };
  for_each_arm_field(write, nominal);
}

void write_effects(XmlWriter& xml, const ArmModel& model) {
  if (model.effects.empty()) return;
  xml.open("effects");
  for (const PlacedEffect& placed : model.effects) {
    xml.open("effect");
    xml.attribute("name", placed.effect->name());
    if (placed.joint) xml.attribute("joint", std::to_string(*placed.joint + 1));
    const std::vector<EffectParameter> parameters = placed.effect->parameters(model.nominal, placed.joint);
    for (std::size_t i = 0; i < parameters.size(); ++i) xml.attribute(parameters[i].name.c_str(), placed.p[i]);
    xml.close();
  }
  xml.close();
}

void write_source(XmlWriter& xml, const ColumnSource& source) {
  xml.attribute("from", source.column);
  if (source.electric_unit.empty()) {
    xml.attribute("scale", source.scale);
  } else {
    xml.attribute("unit", source.electric_unit);
    xml.attribute("sign", source.scale < 0 ? -1 : 1);
  }
  xml.attribute("offset", source.offset);
  if (source.wrap > 0) xml.attribute("wrap", source.wrap);
}

void write_columns(XmlWriter& xml, const ColumnMap& columns) {
  if (columns.sources().empty()) return;
  xml.open("columns");
  for (const auto& [name, source] : columns.sources()) {
    xml.open("column");
    xml.attribute("name", name);
    if (source.column.empty()) xml.attribute("left_out", std::string("true"));
    else write_source(xml, source);
    xml.close();
  }
  xml.close();
}

}  // namespace

std::string model_to_xml(const ArmModel& model) {
  XmlWriter xml;
  xml.open("arm");
  xml.attribute("name", model.name);
  write_arm_fields(xml, model.nominal);
  for (int k = 0; k < model.n(); ++k) write_joint(xml, model.nominal.joint[k], k, model.joints[k]);
  write_effects(xml, model);
  write_columns(xml, model.columns);
  for (const auto& [name, options] : model.estimators) {
    xml.open("estimator");
    xml.attribute("name", name);
    for (const auto& [key, value] : options) xml.attribute(key.c_str(), value);
    xml.close();
  }
  xml.close();
  return xml.result();
}

}  // namespace halyard
