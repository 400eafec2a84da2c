#include <stdexcept>

#include "model/xml/xml_writer.h"
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
    xml_.declare();
    xml_.open("scenario");
    xml_.attribute("name", scenario.name);
    xml_.attribute("model", from_folder(model));
    xml_.attribute("duration", scenario.duration_s);
    xml_.attribute("seed", std::to_string(scenario.seed));
    if (scenario.engine) xml_.attribute("engine", word_for(*scenario.engine));
    for (std::size_t k = 0; k < scenario.trajectory.size(); ++k) write(scenario.trajectory[k], k + 1);
    xml_.element("control", {{"period", scenario.control_period_s}, {"fade_in", scenario.fade_in_s}});
    write(scenario.integrator);
    write_sensors(scenario);
    if (scenario.camera) write(*scenario.camera);
    xml_.close();
    return xml_.result();
  }

 private:
  void numbers(const char* name, const std::vector<double>& values) {
    if (!values.empty()) xml_.attribute(name, values);
  }
  static std::string yes_or_no(bool value) { return value ? "true" : "false"; }
  std::string from_folder(const fs::path& path) const { return fs::proximate(fs::absolute(path), folder_).string(); }

  void write(const JointTrajectory& t, std::size_t joint) {
    using Kind = JointTrajectory::Kind;
    xml_.open("trajectory");
    xml_.attribute("joint", std::to_string(joint));
    xml_.attribute("kind", word_for(t.kind));
    switch (t.kind) {
      case Kind::hold: xml_.attribute("center", t.center); break;
      case Kind::sines:
        xml_.attribute("center", t.center);
        for (const Sine& sine : t.sines) write(sine);
        break;
      case Kind::point_to_point:
        numbers("points", t.points);
        xml_.attribute("move", t.move_s);
        xml_.attribute("dwell", t.dwell_s);
        break;
      case Kind::samples:
        if (t.file.empty()) throw std::invalid_argument("scenario_xml: samples that are in no file cannot be written");
        xml_.attribute("file", from_folder(t.file));
        xml_.attribute("column", t.column);
        break;
    }
    xml_.close();
  }

  void write(const Sine& sine) {
    xml_.element("sine", {{"amplitude", sine.amplitude}, {"frequency", sine.frequency_hz}, {"phase", sine.phase}});
  }

  void write(const IntegratorOptions& options) {
    xml_.open("integrator");
    if (options.kind != IntegratorKind::automatic) xml_.attribute("treatment", word_for(options.kind));
    xml_.attribute("relative_tolerance", options.relative_tolerance);
    if (!is_of_simbody(options.kind)) xml_.attribute("absolute_tolerance", options.absolute_tolerance);
    xml_.close();
  }

  void write_sensors(const Scenario& scenario) {
    xml_.open("sensors");
    xml_.attribute("quantise", yes_or_no(scenario.quantise));
    xml_.attribute("homed", yes_or_no(scenario.homed));
    numbers("torque_noise", scenario.noise.motor_torque);
    numbers("motor_position_noise", scenario.noise.motor_reading);
    numbers("joint_position_noise", scenario.noise.joint_reading);
    xml_.close();
  }

  void write(const Camera& camera) {
    xml_.element("camera", {{"rate", camera.rate_hz},
                            {"latency", camera.latency_s},
                            {"noise", camera.noise_m},
                            {"dropout", camera.dropout}});
  }

  fs::path folder_;
  XmlWriter xml_;
};

}  // namespace

std::string scenario_xml(const Scenario& scenario, const fs::path& model, const fs::path& folder) {
  return ScenarioWriter(folder).written(scenario, model);
}

}  // namespace halyard
