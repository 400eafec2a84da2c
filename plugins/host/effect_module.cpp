#include "plugins/host/effect_module.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <string_view>
#include <type_traits>
#include <utility>

#include "model/input_error.h"
#include "model/output/read_files.h"
#include "plugins/effect_plugin.hpp"
#include "plugins/host/plain_name.h"
#include "plugins/host/shared_module.h"
#include "transmission/arm_fields.h"

namespace halyard {
namespace {

constexpr const char* kSymbol = "halyard_effects";
constexpr const char* kRebuild = "; rebuild it against the installed headers";

using Effects = std::vector<std::unique_ptr<const Effect>>;

[[noreturn]] void refuse(const SharedModule& module, const std::string& why) {
  throw InputError("plugin " + module.path().string() + ": " + one_line(why));
}

const halyard_effect_table& checked_table(const SharedModule& module) {
  const auto exported = reinterpret_cast<decltype(&halyard_effects)>(module.symbol(kSymbol));
  if (!exported) {
    refuse(module,
           std::string("exports no function ") + kSymbol + "; it holds no effects, or its function lacks extern \"C\"");
  }
  const halyard_effect_table* table = called(exported, module, kSymbol);
  if (!table) refuse(module, std::string(kSymbol) + "() returns no table; return the address of a static one");
  if (table->interface_version != HALYARD_EFFECT_INTERFACE) {
    refuse(module, "built for effect interface " + std::to_string(table->interface_version) + ", this program speaks " +
                       std::to_string(HALYARD_EFFECT_INTERFACE) + kRebuild);
  }
  if (table->table_size != sizeof *table) {
    refuse(module, "its table has " + std::to_string(table->table_size) + " bytes, this program's has " +
                       std::to_string(sizeof *table) + kRebuild);
  }
  if (!table->compiler || !table->layout || !table->make) refuse(module, "its table lacks an entry; fill every entry");
  if (table->compiler != std::string_view(kEffectCompiler)) {
    refuse(module, "compiled by " + in_quotes(table->compiler) + ", this program by " + in_quotes(kEffectCompiler) +
                       "; rebuild it with this program's compiler");
  }
  if (!std::equal(table->layout, table->layout + table->layout_size, std::begin(kEffectLayout),
                  std::end(kEffectLayout)))
    refuse(module, std::string("the types that it shares with this program have other sizes there") + kRebuild);
  return *table;
}

/// An arm on which any effect can be asked for its parameters.
ArmParameters<double> plain_arm() {
  ArmParameters<double> arm;
  arm.n = 3;
  for (int k = 0; k < arm.n; ++k) {
    JointParameters<double>& j = arm.joint[k];
    j.mass = j.rotor_inertia = j.coupling[k] = 1;
    j.stiffness = 1e4;
    j.damping = j.tension = 10;
  }
  return arm;
}

/// Why a module's effects are refused. No InputError: one of those may also come from the module's own code.
struct Refusal {
  std::string why;
};

/// Filters take the scale of each state as the size of its noise.
bool has_scale_of_each_state(const Effect& effect, const ArmParameters<double>& arm, EffectPlace place) {
  const PlacedEffect placed = place_effect(effect, arm, place);
  const std::vector<double> scales = effect.state_scale(arm, place, placed.p);
  return static_cast<int>(scales.size()) == effect.n_states() &&
         std::ranges::all_of(scales, [](double scale) { return std::isfinite(scale) && scale >= 0; });
}

/// Calls visit(x) for each number of the arm, but for those that are no double.
template <class Arm, class Visit>
void for_each_number(Arm& arm, const Visit& visit) {
  const auto visit_field = [&](const ArmField&, auto& value) {
    using Value = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, double>) visit(value);
    else if constexpr (std::rank_v<Value> == 1)
      for (auto& x : value) visit(x);
  };
  for_each_arm_field(visit_field, arm);
  for (int k = 0; k < arm.n; ++k) for_each_joint_field(visit_field, arm.joint[k]);
}

std::vector<double> numbers_of(const ArmParameters<double>& arm) {
  std::vector<double> all;
  for_each_number(arm, [&](double x) { all.push_back(x); });
  return all;
}

/// False for an effect that acts at no stage and changes no number of an arm.
bool does_something(const Effect& effect, ArmParameters<double> arm, EffectPlace place) {
  if (effect.stages() != 0) return true;
  for_each_number(arm, [](double& x) { x += 0.1; });  // a factor would leave a 0
  ArmParameters<double> changed = arm;
  effect.change_parameters(changed, place, place_effect(effect, arm, place).p);
  return numbers_of(changed) != numbers_of(arm);
}

void check_effect(const Effect& effect) {
  const std::string name = effect.name();
  const auto refuse_effect = [&](const std::string& why) { throw Refusal{"effect " + in_quotes(name) + " " + why}; };
  if (!is_plain_name(name)) refuse_effect("cannot be named so; use letters, digits, '_' and '-', at most 64");
  if (find_effect(name)) refuse_effect("is already in the library; give yours another name");
  if (effect.n_states() < 0 || effect.n_states() > kMaxEffectStates) {
    refuse_effect("has " + std::to_string(effect.n_states()) + " states; the most is " +
                  std::to_string(kMaxEffectStates));
  }
  const ArmParameters<double> arm = plain_arm();
  for (const EffectPlace place : effect_places(effect, arm)) {
    const std::vector<EffectParameter> parameters = effect.parameters(arm, place);
    if (parameters.empty() || parameters.size() > kMaxEffectParameters) {
      refuse_effect("has " + std::to_string(parameters.size()) + " parameters; give it 1 to " +
                    std::to_string(kMaxEffectParameters));
    }
    for (const EffectParameter& p : parameters) {
      if (!is_plain_name(p.name))
        refuse_effect("has a parameter " + in_quotes(p.name) + "; use letters, digits, '_' and '-', at most 64");
      const std::string bounds = fmt::format("[{:g}, {:g}]", p.lower, p.upper);
      if (!(p.lower < p.upper))
        refuse_effect(fmt::format("has {} with the bounds {}; give it a lower bound below the upper one",
                                  in_quotes(p.name), bounds));
      for (const auto& [what, value] : {std::pair("neutral", p.neutral), std::pair("typical", p.typical)})
        if (!(p.lower <= value && value <= p.upper))
          refuse_effect(fmt::format("has {} with the {} value {:g} outside its bounds {}; correct one of them",
                                    in_quotes(p.name), what, value, bounds));
    }
    if (parameters.front().is_shape())
      refuse_effect("lists the shape " + in_quotes(parameters.front().name) +
                    " before any size; list the sizes that it belongs to first");
    if (!does_something(effect, arm, place))
      refuse_effect("acts at no stage and changes no number of an arm; define stages()");
    if (!has_scale_of_each_state(effect, arm, place))
      refuse_effect("must give its " + std::to_string(effect.n_states()) +
                    " states one scale each, finite and not negative; correct state_scale()");
  }
}

Effects checked_effects(const SharedModule& module, const halyard_effect_table& table) {
  Effects effects;
  try {
    table.make(effects);
    if (effects.empty()) throw Refusal{"makes no effect"};
    for (std::size_t i = 0; i < effects.size(); ++i) {
      if (!effects[i]) throw Refusal{"makes an effect that is null"};
      check_effect(*effects[i]);
      for (std::size_t j = 0; j < i; ++j)
        if (effects[j]->name() == effects[i]->name())
          throw Refusal{"makes " + in_quotes(effects[i]->name()) + " twice; give each a name of its own"};
    }
  } catch (const Refusal& refusal) {
    refuse(module, refusal.why);
  } catch (const std::exception& error) {
    refuse(module, std::string("its effects cannot be made: ") + error.what());
  } catch (...) {
    refuse(module, "its effects cannot be made: it lets an exception out");
  }
  return effects;
}

struct OpenModule {
  std::unique_ptr<SharedModule> module;
  std::filesystem::path path;        ///< absolute
  std::vector<std::string> effects;  ///< names
};

/// Never destroyed: the library lives until the process ends, and its effects are code of their modules.
std::vector<OpenModule>& open_modules() {
  static auto& modules = *new std::vector<OpenModule>;
  return modules;
}

}  // namespace

void load_effects(const std::filesystem::path& path) {
  OpenModule opened{std::make_unique<SharedModule>(path), std::filesystem::absolute(path), {}};
  note_read(path);
  for (auto& effect : checked_effects(*opened.module, checked_table(*opened.module))) {
    opened.effects.push_back(effect->name());
    register_effect(std::move(effect));
  }
  open_modules().push_back(std::move(opened));
}

std::vector<std::filesystem::path> loaded_effect_modules() {
  std::vector<std::filesystem::path> paths;
  for (const OpenModule& module : open_modules()) paths.push_back(module.path);
  return paths;
}

bool is_from_module(const Effect& effect) {
  return std::ranges::any_of(open_modules(), [&](const OpenModule& module) {
    return std::ranges::find(module.effects, effect.name()) != module.effects.end();
  });
}

}  // namespace halyard
