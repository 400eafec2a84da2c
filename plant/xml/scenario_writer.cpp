#include <tinyxml2.h>

#include <stdexcept>

#include "model/xml/xml_reader.h"
#include "plant/xml/scenario_words.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

class ScenarioWriter {
 public:
  explicit ScenarioWriter(const fs::path& folder) : folder_(fs::absolute(folder)) {}

  std::string written(const Scenario& scenario, const fs::path& model) {
    if (!scenario.noise.joint_force.empty())
      throw std::invalid_argument("scenario_xml: noise of joint forces cannot be written");
    xml_.PushHeader(false, true);
    xml_.OpenElement("scenario");
    text("name", scenario.name);
    text("model", from_folder(model));
    number("duration", scenario.duration_s);
    text("seed", std::to_string(scenario.seed));
    if (scenario.engine) text("engine", word_for(*scenario.engine));
    for (std::size_t k = 0; k < scenario.trajectory.size(); ++k) write(scenario.trajectory[k], k + 1);
    xml_.OpenElement("control");
    number("period", scenario.control_period_s);
    number("fade_in", scenario.fade_in_s);
    xml_.CloseElement();
    write(scenario.integrator);
    write_sensors(scenario);
    if (scenario.camera) write(*scenario.camera);
    xml_.CloseElement();
    return xml_.CStr();
  }

 private:
  void text(const char* name, const std::string& value) { xml_.PushAttribute(name, value.c_str()); }
  void number(const char* name, double value) { text(name, exact_text(value)); }
  void numbers(const char* name, const std::vector<double>& values) {
    std::string all;
    for (const double value : values) all.append(all.empty() ? "" : " ").append(exact_text(value));
    if (!all.empty()) text(name, all);
  }
  std::string from_folder(const fs::path& path) const { return fs::proximate(fs::absolute(path), folder_).string(); }

  void write(const JointTrajectory& t, std::size_t joint) {
    using Kind = JointTrajectory::Kind;
    xml_.OpenElement("trajectory");
    text("joint", std::to_string(joint));
    text("kind", word_for(t.kind));
    switch (t.kind) {
      case Kind::hold: number("center", t.center); break;
      case Kind::sines:
        number("center", t.center);
        for (const Sine& sine : t.sines) write(sine);
        break;
      case Kind::point_to_point:
        numbers("points", t.points);
        number("move", t.move_s);
        number("dwell", t.dwell_s);
        break;
      case Kind::samples:
        if (t.file.empty()) throw std::invalid_argument("scenario_xml: samples that are in no file cannot be written");
        text("file", from_folder(t.file));
        text("column", t.column);
        break;
    }
    xml_.CloseElement();
  }

  void write(const Sine& sine) {
    xml_.OpenElement("sine");
    number("amplitude", sine.amplitude);
    number("frequency", sine.frequency_hz);
    number("phase", sine.phase);
    xml_.CloseElement();
  }

  void write(const IntegratorOptions& options) {
    xml_.OpenElement("integrator");
    if (options.kind != IntegratorKind::automatic) text("treatment", word_for(options.kind));
    number("relative_tolerance", options.relative_tolerance);
    if (!is_of_simbody(options.kind)) number("absolute_tolerance", options.absolute_tolerance);
    xml_.CloseElement();
  }

  void write_sensors(const Scenario& scenario) {
    xml_.OpenElement("sensors");
    xml_.PushAttribute("quantise", scenario.quantise);
    xml_.PushAttribute("homed", scenario.homed);
    numbers("torque_noise", scenario.noise.motor_torque);
    numbers("motor_position_noise", scenario.noise.motor_reading);
    numbers("joint_position_noise", scenario.noise.joint_reading);
    xml_.CloseElement();
  }

  void write(const Camera& camera) {
    xml_.OpenElement("camera");
    number("rate", camera.rate_hz);
    number("latency", camera.latency_s);
    number("noise", camera.noise_m);
    number("dropout", camera.dropout);
    xml_.CloseElement();
  }

  fs::path folder_;
  tinyxml2::XMLPrinter xml_;
};

}  // namespace

std::string scenario_xml(const Scenario& scenario, const fs::path& model, const fs::path& folder) {
  return ScenarioWriter(folder).written(scenario, model);
}

}  // namespace halyard
