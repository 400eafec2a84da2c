#include <tinyxml2.h>

#include <initializer_list>
#include <span>

#include "model/model_file.h"
#include "model/xml_reader.h"

namespace halyard {
namespace {

using Joint = JointParameters<double>;

std::string list(std::span<const double> values) {
  std::string text;
  for (const double value : values) text.append(text.empty() ? "" : " ").append(exact_text(value));
  return text;
}

class Writer {
 public:
  void open(const char* tag) { printer_.OpenElement(tag); }
  void close() { printer_.CloseElement(); }
  void attribute(const char* name, const std::string& text) { printer_.PushAttribute(name, text.c_str()); }
  void attribute(const char* name, double value) { attribute(name, exact_text(value)); }
  void text(const std::string& text) { printer_.PushText(text.c_str()); }

  struct Number {
    const char* name;
    double value;
  };
  void element(const char* tag, std::initializer_list<Number> numbers) {
    open(tag);
    for (const Number& number : numbers) attribute(number.name, number.value);
    close();
  }
  std::string result() const { return printer_.CStr(); }

 private:
  tinyxml2::XMLPrinter printer_;
};

void write_drive(Writer& xml, const Joint& j, int k, const ControllerParameters& controller) {
  xml.element("motor", {{"inertia", j.rotor_inertia},
                        {"coulomb", j.motor_coulomb},
                        {"viscous", j.motor_viscous},
                        {"smoothing", j.motor_smoothing},
                        {"gear_ratio", j.gear_ratio},
                        {"capstan_radius", j.capstan_radius},
                        {"torque_scale", j.torque_scale},
                        {"torque_bias", j.torque_bias}});
  if (j.drive == Drive::rigid) {
    xml.element("rigid", {{"pulley_radius", j.pulley_radius}});
  } else {
    const bool exponential = j.law == CableLaw::exponential;
    xml.open("cable");
    xml.attribute("law", j.law == CableLaw::paper ? "paper" : exponential ? "exponential" : "linear");
    xml.attribute("stiffness", j.stiffness);
    xml.attribute("damping", j.damping);
    xml.attribute("tension", j.tension);
    xml.attribute("pulley_radius", j.pulley_radius);
    xml.close();
  }
  for (int inboard = 0; inboard < k; ++inboard) {
    if (j.coupling[inboard] == 0) continue;
    xml.element("coupling", {{"joint", inboard + 1.0}, {"coefficient", j.coupling[inboard]}});
  }
  xml.element("controller", {{"kp", controller.kp}, {"kd", controller.kd}, {"torque_limit", controller.torque_limit}});
}

void write_encoders(Writer& xml, const Joint& j) {
  const auto offset = [&](const char* name, double value, bool known) {
    xml.attribute(name, known ? exact_text(value) : "unknown");
  };
  xml.open("encoders");
  if (j.drive != Drive::none) {
    xml.attribute("motor_resolution", j.motor_encoder_resolution);
    offset("motor_offset", j.motor_encoder_offset, j.motor_zero_known);
  }
  xml.attribute("joint_resolution", j.joint_encoder_resolution);
  offset("joint_offset", j.joint_encoder_offset, j.joint_zero_known);
  xml.close();
}

void write_joint(Writer& xml, const Joint& j, int k, const JointDescription& description) {
  xml.open("joint");
  xml.attribute("name", description.name);
  xml.attribute("type", j.type == JointType::revolute ? "revolute" : "prismatic");
  xml.attribute("drive", j.drive == Drive::cable ? "cable" : j.drive == Drive::rigid ? "rigid" : "none");
  xml.open("frame");
  xml.attribute("xyz", list(j.frame_p));
  xml.attribute("matrix", list({&j.frame_R[0][0], 9}));
  xml.close();
  xml.open("link");
  xml.attribute("mass", j.mass);
  xml.attribute("com", list(j.com));
  xml.attribute("inertia", list(j.inertia));
  xml.close();
  if (j.drive != Drive::none) write_drive(xml, j, k, description.controller);
  xml.element("friction",
              {{"coulomb", j.joint_coulomb}, {"viscous", j.joint_viscous}, {"smoothing", j.joint_smoothing}});
  write_encoders(xml, j);
  xml.element("range", {{"lower", description.lower}, {"upper", description.upper}, {"home", description.home}});
  const Tolerances& t = description.tolerances;
  xml.element("tolerances", {{"length", t.length},
                             {"mass", t.mass},
                             {"stiffness", t.stiffness},
                             {"friction", t.friction},
                             {"coupling", t.coupling},
                             {"torque_scale", t.torque_scale}});
  xml.close();
}

void write_effects(Writer& xml, const ArmModel& model) {
  if (model.effects.empty()) return;
  xml.open("effects");
  for (const PlacedEffect& placed : model.effects) {
    xml.open("effect");
    xml.attribute("name", placed.effect->name());
    if (placed.joint >= 0) xml.attribute("joint", std::to_string(placed.joint + 1));
    const std::vector<EffectParameter> parameters = placed.effect->parameters(model.nominal, placed.joint);
    for (std::size_t i = 0; i < parameters.size(); ++i) xml.attribute(parameters[i].name.c_str(), placed.p[i]);
    xml.close();
  }
  xml.close();
}

void write_columns(Writer& xml, const ColumnMap& columns) {
  if (columns.sources().empty()) return;
  xml.open("columns");
  for (const auto& [name, source] : columns.sources()) {
    xml.open("column");
    xml.attribute("name", name);
    xml.attribute("from", source.column);
    xml.attribute("scale", source.scale);
    xml.attribute("offset", source.offset);
    xml.close();
  }
  xml.close();
}

}  // namespace

std::string model_to_xml(const ArmModel& model) {
  Writer xml;
  xml.open("arm");
  xml.attribute("name", model.name);
  xml.open("gravity");
  xml.text(list(model.nominal.gravity));
  xml.close();
  xml.open("payload");
  xml.attribute("point", list(model.nominal.payload_point));
  xml.close();
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
