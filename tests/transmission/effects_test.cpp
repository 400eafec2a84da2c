#include "transmission/effects/library.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "model/arm_model.h"
#include "tests/support/effect_runs.h"

namespace halyard {
namespace {

/// All built-in effects at all places where they can be.
std::vector<PlacedEffect> built_in_everywhere(const ArmParameters<double>& arm) {
  std::vector<PlacedEffect> all;
  for (const auto& made : built_in_effects()) {
    const Effect* effect = find_effect(made->name());
    for (const EffectPlace joint : effect_places(*effect, arm)) all.push_back(place_effect(*effect, arm, joint));
  }
  return all;
}

// -------------------------------------------------------------------------------------- all effects

TEST(EffectLibrary, ParametersLieInsideTheirBoundsAndAreNamed) {
  for (const PlacedEffect& e : built_in_everywhere(random_arm(1, CableLaw::linear))) {
    SCOPED_TRACE(e.effect->name());
    const auto parameters = e.effect->parameters(random_arm(1, CableLaw::linear), e.joint);
    ASSERT_FALSE(parameters.empty());
    ASSERT_LE(parameters.size(), static_cast<std::size_t>(kMaxEffectParameters));
    EXPECT_LE(e.effect->n_states(), kMaxEffectStates);
    EXPECT_FALSE(e.effect->summary().empty());
    bool differs = false;
    for (const EffectParameter& p : parameters) {
      EXPECT_FALSE(p.name.empty());
      EXPECT_FALSE(p.unit.empty());
      EXPECT_LT(p.lower, p.upper) << p.name;
      EXPECT_LE(p.lower, p.neutral) << p.name;
      EXPECT_LE(p.neutral, p.upper) << p.name;
      EXPECT_LE(p.lower, p.typical) << p.name;
      EXPECT_LE(p.typical, p.upper) << p.name;
      differs = differs || p.typical != p.neutral;
    }
    EXPECT_TRUE(differs) << "its typical values have no influence";
  }
}

TEST(EffectLibrary, NeutralParametersChangeNothing) {
  for (const CableLaw law : kLaws) {
    const ArmParameters<double> arm = random_arm(2, law);
    const EvaluatedArm<double> bare{arm, {}};
    for (PlacedEffect e : built_in_everywhere(arm)) {
      SCOPED_TRACE(effect_label(e));
      const auto parameters = e.effect->parameters(arm, e.joint);
      for (std::size_t i = 0; i < parameters.size(); ++i) e.p[i] = parameters[i].neutral;
      const EvaluatedArm<double> with{arm, e};
      std::mt19937_64 random(3);
      for (int trial = 0; trial < 5; ++trial) {
        std::vector<double> u = random_inputs(with, random);
        if (trial == 0) std::fill(u.begin(), u.begin() + 6 * arm.n, 0.0);  // at rest, unstretched
        if (trial == 1)                                                    // unstretched, moving
          for (int k = 0; k < arm.n; ++k) u[6 * k + 1] = u[6 * k + 3] = 0;
        double command[3];
        for (int k = 0; k < arm.n; ++k) command[k] = u[6 * k];
        CommandHistory history(arm.n, 1);
        history.push(0, command);
        const double time = trial;
        const std::vector<double> expected = bare(u, time, &history), got = with(u, time, &history);
        const int m = with.n_states();  // the rates of its own states come first
        for (std::size_t r = 0; r < expected.size(); ++r) EXPECT_EQ(got[r + m], expected[r]) << "output " << r;
      }
      ArmParameters<double> changed = arm, same = arm;
      e.effect->change_parameters(changed, e.joint, e.p);
      const auto a = named_parameters(changed), b = named_parameters(same);
      for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].number.get(), b[i].number.get()) << a[i].name;
    }
  }
}

TEST(EffectLibrary, TypicalParametersChangeSomething) {
  const ArmParameters<double> arm = random_arm(2, CableLaw::linear);
  const EvaluatedArm<double> bare{arm, {}};
  for (const PlacedEffect& e : built_in_everywhere(arm)) {
    if (e.effect->scope() == EffectScope::arm) {  // it changes the chain alone
      ArmParameters<double> changed = arm;
      e.effect->change_parameters(changed, e.joint, e.p);
      EXPECT_TRUE(changed.joint[2].mass != arm.joint[2].mass || changed.gravity[0] != arm.gravity[0])
          << e.effect->name();
      continue;
    }
    const EvaluatedArm<double> with{arm, e};
    std::mt19937_64 random(3);
    std::vector<double> u = random_inputs(with, random);
    for (int k = 0; k < arm.n; ++k) u[6 * k] *= 50;  // a command that saturates, at a time when slow things have begun
    const std::vector<double> expected = bare(u, 1.5), got = with(u, 1.5);
    bool differs = false;
    for (std::size_t r = 0; r < expected.size(); ++r) differs = differs || got[r + with.n_states()] != expected[r];
    EXPECT_TRUE(differs) << effect_label(e);
  }
}

TEST(EffectLibrary, AShapeFollowsASizeAndDoesNothingWithoutIt) {
  const ArmParameters<double> arm = random_arm(2, CableLaw::linear);
  const EvaluatedArm<double> bare{arm, {}};
  std::mt19937_64 random(8);
  for (PlacedEffect e : built_in_everywhere(arm)) {
    const auto parameters = e.effect->parameters(arm, e.joint);
    EXPECT_FALSE(parameters[0].is_shape()) << e.effect->name();
    for (std::size_t i = 0; i < parameters.size(); ++i) e.p[i] = parameters[i].neutral;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      if (!parameters[i].is_shape()) continue;
      const double step = 0.3 * (parameters[i].upper - parameters[i].lower);
      PlacedEffect moved = e;
      moved.p[i] = parameters[i].lower + step;
      const EvaluatedArm<double> with{arm, moved};
      const std::vector<double> u = random_inputs(with, random), expected = bare(u, 1.5), got = with(u, 1.5);
      for (std::size_t r = 0; r < expected.size(); ++r)
        EXPECT_EQ(got[r + with.n_states()], expected[r]) << e.effect->name() << " " << parameters[i].name;
    }
  }
}

TEST(EffectLibrary, HasTheEffectsInTheOrderOfTheirNamesTable) {
  const char* names[] = {"payload",
                         "gravity_tilt",
                         "motor_friction",
                         "joint_friction",
                         "motor_presliding",
                         "joint_presliding",
                         "stribeck",
                         "pulley_friction",
                         "hysteresis",
                         "backlash",
                         "slack",
                         "stiffness",
                         "coupling",
                         "creep",
                         "capstan_ratio",
                         "capstan_eccentricity",
                         "encoder_offset",
                         "encoder_eccentricity",
                         "torque_ripple",
                         "torque_scale",
                         "delay",
                         "cable_slip",
                         "external_force",
                         "friction_drift",
                         "actuator_saturation"};
  const auto built_in = built_in_effects();
  ASSERT_EQ(built_in.size(), std::size(names));
  for (std::size_t i = 0; i < built_in.size(); ++i) EXPECT_EQ(built_in[i]->name(), names[i]);
}

TEST(EffectLibrary, AnEffectIsOneFileAndOneLine) {
  const std::filesystem::path folder = std::filesystem::path(HALYARD_SOURCE_DIR) / "transmission/effects";
  const auto text = [](const std::filesystem::path& path) {
    std::ostringstream all;
    all << std::ifstream(path).rdbuf();
    return all.str();
  };
  const std::string library = text(folder / "library.cpp");
  const std::regex made(R"(HALYARD_EFFECT\((\w+)\))");
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".cpp" || entry.path().parent_path() == folder) continue;
    ++files;
    const std::string file = text(entry.path());
    std::smatch name;
    ASSERT_TRUE(std::regex_search(file, name, made)) << entry.path() << " makes no effect";
    EXPECT_NE(library.find("\n    make_effect<class " + name[1].str() + ">,\n"), library.npos)
        << entry.path() << " has no line in library.cpp";
  }
  EXPECT_EQ(files, built_in_effects().size());
}

TEST(EffectLibrary, EffectsAreFoundByNameAndRefusedWhereTheyCannotBe) {
  ArmParameters<double> arm = random_arm(1, CableLaw::linear);
  EXPECT_EQ(find_effect("no such effect"), nullptr);
  EXPECT_FALSE(find_effect("coupling")->applies(arm, 0)) << "no joint is inboard of the first";
  arm.joint[1].drive = Drive::rigid;
  arm.joint[2].drive = Drive::none;
  for (const char* of_cable : {"backlash", "hysteresis", "stiffness", "pulley_friction", "slack", "creep",
                               "capstan_eccentricity", "cable_slip"})
    EXPECT_FALSE(find_effect(of_cable)->applies(arm, 1)) << of_cable;
  for (const char* of_motor : {"motor_friction", "motor_presliding", "capstan_ratio", "encoder_offset", "coupling",
                               "torque_ripple", "torque_scale", "actuator_saturation"}) {
    EXPECT_TRUE(find_effect(of_motor)->applies(arm, 1)) << of_motor;
    EXPECT_FALSE(find_effect(of_motor)->applies(arm, 2)) << of_motor;
  }
  EXPECT_TRUE(find_effect("joint_friction")->applies(arm, 2));

  const auto message = [&](const char* name, EffectPlace joint) -> std::string {
    try {
      place_effect(*find_effect(name), arm, joint);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(message("backlash", 1), "effect backlash cannot be at joint 2 of this arm");
  EXPECT_EQ(message("backlash", 3), "effect backlash cannot be at joint 4 of this arm");
  EXPECT_EQ(message("backlash", kWholeArm), "effect backlash belongs to a joint: name one");
  EXPECT_EQ(message("payload", 0), "effect payload belongs to the whole arm: name no joint");
}

TEST(EffectLibrary, EveryStateHasARateAndNothingElseIsWritten) {
  const ArmParameters<double> arm = random_arm(4, CableLaw::linear);
  constexpr double kUntouched = 1e300;
  std::mt19937_64 random(6);
  for (const PlacedEffect& e : built_in_everywhere(arm)) {
    const Transmission<double> transmission(arm, {e});
    const std::vector<double> z(kMaxEffectStates, 0.01);
    Evaluated moving = evaluate(transmission, random_motion(random), z.data());
    std::vector<double> z_dot(kMaxEffectStates, kUntouched);
    transmission.evaluate(0, nullptr, z.data(), moving.s, z_dot.data());
    for (int i = 0; i < kMaxEffectStates; ++i)
      EXPECT_EQ(z_dot[i] != kUntouched, i < e.effect->n_states()) << effect_label(e) << " " << i;
  }
}

TEST(EffectLibrary, StagesAreSingleBits) {
  unsigned all = 0;
  for (const EffectStage stage : {EffectStage::command, EffectStage::stretch, EffectStage::cable_force,
                                  EffectStage::motor, EffectStage::joint, EffectStage::sensors}) {
    const auto bit = static_cast<unsigned>(stage);
    EXPECT_TRUE(std::has_single_bit(bit)) << bit;
    EXPECT_EQ(all & bit, 0u) << bit;
    all |= bit;
  }
}

TEST(EffectLibrary, StatesMoveInTheSameWayIfTheTorquesOfTheMotorsAreUnwanted) {
  const ArmParameters<double> arm = random_arm(4, CableLaw::linear);
  std::mt19937_64 random(5);
  for (const PlacedEffect& e : built_in_everywhere(arm)) {
    const Transmission<double> transmission(arm, {e});
    const std::vector<double> z(kMaxEffectStates, 0.01);
    Evaluated wanted = evaluate(transmission, random_motion(random), z.data()), unwanted = wanted;
    double z_dot[kMaxEffectStates] = {};
    transmission.evaluate(0, nullptr, z.data(), unwanted.s, z_dot, MotorTorques::unwanted);
    for (int i = 0; i < transmission.n_states(); ++i) EXPECT_EQ(z_dot[i], wanted.z_dot[i]) << effect_label(e);
  }
}

// --------------------------------------------------------------------------------- a user's effect

/// Torque that acts after a delay, through a motor that follows with a time constant and hums with the mains: uses past
/// commands, an internal state and the time.
class SlowMotor : public EffectOf<SlowMotor> {
 public:
  explicit SlowMotor(std::string name = "slow_motor") : name_(std::move(name)) {}
  std::string name() const override { return name_; }
  std::string summary() const override { return "late, slow, humming torque"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::command); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override {
    return {{"delay", "s", 0, 0.02, 0, 0.1}, {"time_constant", "s", 0.05, 0.05, 0.01, 1}, {"hum", "N m", 0, 0.1, 0, 1}};
  }
  int n_states() const override { return 1; }

  template <class T>
  void on_command(const EffectContext<T>& c, JointSignals<T>* s) const {
    s[*c.joint].motor_torque = c.z[0] + c.p[2] * std::sin(kMains * c.time);
  }
  template <class T>
  void state_rate(const EffectContext<T>& c, const JointSignals<T>* s, T* z_dot) const {
    const T late = c.history ? c.history->at(*c.joint, T(c.time) - c.p[0]) : s[*c.joint].command;
    z_dot[0] = (late - c.z[0]) / c.p[1];
  }

  static constexpr double kMains = 314.16;

 private:
  std::string name_;
};

TEST(UsersEffect, WithStateTimeAndPastCommandsWorksOverEveryScalarWithoutTheLibrary) {
  ArmParameters<double> arm = random_arm(13, CableLaw::linear);
  arm.joint[1].motor_coulomb = arm.joint[1].motor_viscous = 0;
  const SlowMotor effect;
  const PlacedEffect e = place_effect(effect, arm, 1);
  CommandHistory history(3, 1);
  for (int i = 0; i < 100; ++i) {
    const double command[] = {0, 10 * i * 1e-3, 0};  // a ramp
    history.push(i * 1e-3, command);
  }
  const double time = 0.0805, delay = 0.02, time_constant = 0.05, state = 0.3;
  const EvaluatedArm<double> plain{arm, e};
  std::mt19937_64 random(1);
  std::vector<double> u = random_inputs(plain, random);
  u[6 * arm.n] = state;
  const std::vector<double> out = plain(u, time, &history);
  const int torque = 1 + 8;  // after the state's rate and joint 1's signals
  // 10 N m/s times the time that has passed since the ramp began, less half a hold.
  EXPECT_NEAR(out[0], (10 * (time - delay - 0.5e-3) - state) / time_constant, 20 * 8 * kEps);
  EXPECT_NEAR(out[torque], state + 0.1 * std::sin(SlowMotor::kMains * time), 4 * kEps);
  EXPECT_NE(out[torque], plain(u, time + 1e-3, &history)[torque]) << "depends on time";

  const EvaluatedArm<Dual> dual{arm, e};
  std::vector<Dual> seeded(u.begin(), u.end());
  seeded[6 * arm.n] = Dual::seed(state, 0);
  seeded[6 * arm.n + 1] = Dual::seed(delay, 1);
  const std::vector<Dual> derivatives = dual(seeded, time, &history);
  EXPECT_NEAR(derivatives[0].d[0], -1 / time_constant, 20 * 4 * kEps);
  // The slope of a ramp's samples has lost digits: 0.8 N m are good to eps, over 0.01 N m a sample.
  EXPECT_NEAR(derivatives[0].d[1], -10 / time_constant, 200 * 160 * kEps);
  EXPECT_EQ(derivatives[torque].d[0], 1);

  const EvaluatedArm<Lanes> lanes{arm, e};
  std::vector<Lanes> packed(u.begin(), u.end());
  for (int l = 0; l < kLaneWidth; ++l) packed[6 * arm.n + 1].set(l, 0.01 * l);
  const std::vector<Lanes> each = lanes(packed, time, &history);
  for (int l = 0; l < kLaneWidth; ++l) {
    u[6 * arm.n + 1] = 0.01 * l;
    EXPECT_EQ(each[0][l], plain(u, time, &history)[0]);
  }
}

TEST(UsersEffect, KeepsItsStateApartFromThoseOfOtherEffects) {
  const ArmParameters<double> arm = random_arm(13, CableLaw::linear);
  const SlowMotor effect;
  const PlacedEffect hysteresis = place_effect(*find_effect("hysteresis"), arm, 0), mine = place_effect(effect, arm, 2);
  const Transmission<double> both(arm, {hysteresis, mine});
  ASSERT_EQ(both.n_states(), 2);
  std::mt19937_64 random(2);
  const Motion m = random_motion(random);
  const double z[] = {0.01, 0.5};
  const Evaluated together = evaluate(both, m, z), first = evaluate(Transmission<double>(arm, {hysteresis}), m, z),
                  second = evaluate(Transmission<double>(arm, {mine}), m, z + 1);
  EXPECT_EQ(together.z_dot[0], first.z_dot[0]);
  EXPECT_EQ(together.z_dot[1], second.z_dot[0]);
  EXPECT_EQ(together.s[0].cable_force_motor, first.s[0].cable_force_motor);
  EXPECT_EQ(together.s[2].motor_torque, second.s[2].motor_torque);
}

TEST(UsersEffect, JoinsTheLibraryOnceUnderANameOfItsOwn) {
  const std::size_t before = effect_library().size();
  register_effect(std::make_unique<SlowMotor>("slow_motor"));
  ASSERT_NE(find_effect("slow_motor"), nullptr);
  EXPECT_EQ(effect_library().size(), before + 1);
  for (const char* taken : {"slow_motor", "backlash"}) {
    try {
      register_effect(std::make_unique<SlowMotor>(taken));
      FAIL() << taken << " was taken twice";
    } catch (const std::invalid_argument& e) {
      EXPECT_EQ(e.what(), "effect \"" + std::string(taken) + "\" is already in the library: give yours another name");
    }
  }
  EXPECT_EQ(effect_library().size(), before + 1);
}

class ManyStates : public SlowMotor {
 public:
  ManyStates() : SlowMotor("many_states") {}
  int n_states() const override { return kMaxEffectStates + 1; }
};

TEST(UsersEffect, WithMoreStatesThanThereIsRoomForIsRefused) {
  try {
    register_effect(std::make_unique<ManyStates>());
    FAIL() << "joined the library";
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(), "effect \"many_states\" has 9 states: expected at most 8");
  }
  EXPECT_EQ(find_effect("many_states"), nullptr);
}

class ManyNumbers : public EffectOf<ManyNumbers> {
 public:
  std::string name() const override { return "many_numbers"; }
  std::string summary() const override { return "more parameters than an effect can have"; }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override {
    return std::vector<EffectParameter>(kMaxEffectParameters + 1, EffectParameter{"p", "1", 0, 1, 0, 2});
  }
};

TEST(UsersEffect, WithMoreParametersThanThereIsRoomForIsRefused) {
  try {
    place_effect(ManyNumbers(), random_arm(16, CableLaw::linear), 0);
    FAIL() << "was placed";
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(), "effect many_numbers has 9 parameters: expected at most 8");
  }
}

}  // namespace
}  // namespace halyard
