#include "model/xml/field_reader.h"

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <string>
#include <type_traits>
#include <vector>

#include "model/xml/arm_words.h"
#include "transmission/arm_fields.h"

namespace halyard {
namespace {

using Joint = JointParameters<double>;

/// As XmlElement wants it.
std::string unit_of(const ArmField& field, const Joint& joint) {
  const std::string unit = field.unit.of(joint.type);
  return unit == "1" ? "" : unit;
}

Sign sign_of(Bound bound) {
  switch (bound) {
    case Bound::none: return Sign::any;
    case Bound::not_negative: return Sign::non_negative;
    case Bound::positive: return Sign::positive;
  }
  return Sign::any;
}

/// Reads a joint's fields of one part from the element that has the part's name.
class FieldReader {
 public:
  FieldReader(const XmlElement& element, Joint& joint) : element_(element), part_(element.tag()), joint_(joint) {}

  void read() {
    XmlNames names;
    each_field([&](const ArmField& field, auto&) { names.emplace_back(field.name); });
    element_.only(names);
    each_field([&](const ArmField& field, auto& value) { read_value(field, value); });
  }

 private:
  template <class Visit>
  void each_field(Visit visit) {
    const auto of_part = [&](const ArmField& field, auto& value) {
      if (field.part_at(joint_.drive) == part_ && field.exists_at(joint_.drive)) visit(field, value);
    };
    for_each_joint_field(of_part, joint_);
  }

  template <class Value>
  void read_value(const ArmField& field, Value& value) {
    if constexpr (std::is_enum_v<Value>) {
      value = field.has_default ? element_.choice_or(field.name, value, words_of(value))
                                : element_.choice(field.name, words_of(value));
    } else if constexpr (std::is_same_v<Value, double>) {
      read_number(field, value);
    } else if constexpr (std::is_array_v<Value>) {
      const std::vector<double> entries =
          element_.numbers(field.name, unit_of(field, joint_), sizeof value / sizeof(double));
      auto next = entries.begin();
      for_each_entry([&](double& entry) { entry = *next++; }, value);
    }
  }

  void read_number(const ArmField& field, double& value) {
    // Behind a rigid drive the link's inertia is enough; a rotor on an elastic cable moves on its own. The paper's law
    // knows no tension.
    const bool tension = &value == &joint_.tension, paper = joint_.law == CableLaw::paper;
    const bool positive = (&value == &joint_.rotor_inertia && joint_.drive == Drive::cable) || (tension && !paper);
    const Sign sign = positive ? Sign::positive : sign_of(field.bound);
    const std::string unit = unit_of(field, joint_);
    value = field.has_default || (tension && paper) ? element_.number_or(field.name, value, unit, sign)
                                                    : element_.number(field.name, unit, sign);
  }

  const XmlElement& element_;
  std::string part_;
  Joint& joint_;
};

/// From counts a turn or the resolution itself.
double read_resolution(const XmlElement& encoders, const std::string& side, const char* unit) {
  const std::string counts = side + "_counts", resolution = side + "_resolution";
  if (!encoders.has(counts)) return encoders.number_or(resolution, 0, unit, Sign::non_negative);
  if (encoders.has(resolution)) encoders.fail(counts, "expected one of " + counts + " and " + resolution);
  if (std::string(unit) != "rad") encoders.fail(counts, "a prismatic joint has no turn; give " + resolution + " in m");
  const double per_turn = encoders.number(counts, "");
  if (!(per_turn >= 1)) encoders.fail(counts, "expected at least 1 count per turn");
  return 2 * std::numbers::pi / per_turn;
}

}  // namespace

void read_fields(const XmlElement& element, Joint& joint) { FieldReader(element, joint).read(); }

void read_encoders(const XmlElement& encoders, Joint& joint) {
  const auto each_field = [&](const auto& visit) {
    const auto of_encoders = [&](const ArmField& field, auto& value) {
      if (field.part == "encoders" && field.exists_at(joint.drive)) visit(field, value);
    };
    for_each_joint_field(of_encoders, joint);
  };
  const auto side_of = [](const ArmField& field) { return std::string(field.name.substr(0, field.name.find('_'))); };
  const auto is_resolution = [](const ArmField& field) { return field.name.ends_with("_resolution"); };
  XmlNames attributes;
  each_field([&](const ArmField& field, auto& value) {
    if constexpr (std::is_same_v<decltype(value), double&>) {
      if (is_resolution(field)) attributes.push_back(side_of(field) + "_counts");
      attributes.emplace_back(field.name);
    }
  });
  encoders.only(attributes);

  bool zero_known = true;  // of the offset that comes next
  each_field([&](const ArmField& field, auto& value) {
    if constexpr (std::is_same_v<decltype(value), bool&>) {
      value = zero_known = encoders.text_or(field.name, "0") != kUnknownZero;
    } else if constexpr (std::is_same_v<decltype(value), double&>) {
      const char* unit = field.unit.of(joint.type);
      const bool is_unknown = field.name.ends_with("_offset") && !zero_known;
      value = is_resolution(field) ? read_resolution(encoders, side_of(field), unit)
              : is_unknown         ? 0
                                   : encoders.number_or(field.name, 0, unit, sign_of(field.bound));
    }
  });
  if (!joint.joint_zero_known && (joint.drive == Drive::none || !joint.motor_zero_known)) {
    encoders.fail("joint_offset", "there is no other sensor whose zero is known; give this one's");
  }
}

/// Gravity is an element's text, the payload's point an attribute. The joints are counted by who reads them.
void read_arm_fields(const XmlElement& arm, ArmParameters<double>& nominal) {
  const auto read = [&](const ArmField& field, auto& value) {
    if constexpr (std::is_array_v<std::remove_reference_t<decltype(value)>>) {
      const std::string name(field.name), unit = field.unit.of(JointType::revolute);
      if (name.empty()) {
        std::ranges::copy(arm.child(field.part).text_numbers(unit, std::size(value)), value);
      } else if (const auto found = arm.optional_child(field.part)) {
        found->only({name});
        std::ranges::copy(found->numbers(name, unit, std::size(value)), value);
      }
    }
  };
  for_each_arm_field(read, nominal);
}

}  // namespace halyard
