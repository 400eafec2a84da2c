#include "estimators/identification/identified_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "model/drive_ratio.h"
#include "model/input/cell_text.h"
#include "model/input_error.h"

namespace halyard {
namespace {

struct Kind {
  const char* word;
  std::vector<const char*> parts;
};
const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {{"coupling", {".coupling."}},
                                        {"stiffness", {".cable.stiffness"}},
                                        {"damping", {".cable.damping"}},
                                        {"tension", {".cable.tension"}},
                                        {"motor_friction", {".motor.coulomb", ".motor.viscous"}},
                                        {"joint_friction", {".friction.coulomb", ".friction.viscous"}}};
  return all;
}

bool is_of(const Kind& kind, const std::string& key) {
  return std::ranges::any_of(kind.parts, [&](const char* part) { return key.find(part) != key.npos; });
}

[[noreturn]] void fail_kind(const ArmModel& model, const Kind& kind) {
  const std::string word = kind.word;
  const std::string place = fmt::format("parameter {}: {} ", in_quotes(word), model.source);
  if (word == "coupling" && model.n() == 1)
    throw InputError(place + "has one joint, and a joint is coupled with inboard ones; ask for another number");
  if (word == "tension")
    throw InputError(place + "has no cable law that takes tension; write law=\"exponential\" in its <cable>");
  throw InputError(place +
                   "has no such number, or only numbers of 0; ask for others, or name a coupling of 0 by its "
                   "key, such as joint2.coupling.joint1");
}

[[noreturn]] void fail_unknown(const ArmModel& model, const std::string& word, const std::vector<ParameterInfo>& all) {
  std::string words, keys;
  for (const Kind& k : kinds()) words += (words.empty() ? "" : ", ") + std::string(k.word);
  const std::string joint = word.substr(0, word.find('.') + 1);  // of a right joint, its numbers will do
  const bool is_right =
      !joint.empty() && std::ranges::any_of(all, [&](const ParameterInfo& p) { return p.key.starts_with(joint); });
  for (const ParameterInfo& info : all)
    if (info.key.starts_with(is_right ? joint : "joint1.")) keys += (keys.empty() ? "" : ", ") + info.key;
  throw InputError(
      fmt::format("parameter {}: {} has none of that name; expected some of {}, or of the keys {}{}, with "
                  "commas between",
                  in_quotes(word), model.source, words, keys, is_right ? "" : " (the other joints have the like)"));
}

}  // namespace

bool is_in_equations(const ArmModel& model, const ParameterInfo& info) {
  return !info.key.ends_with(".cable.tension") || model.nominal.joint[info.joint].law != CableLaw::paper;
}

std::vector<std::string> identified_keys(const ArmModel& model, const std::string& text) {
  ArmParameters<double> arm = model.nominal;
  const std::vector<ParameterInfo> all = named_parameters(arm);
  std::vector<bool> chosen(all.size(), false);
  std::vector<std::string_view> words;
  split(text, words);
  for (const std::string_view trimmed : words) {
    const std::string word(trimmed);
    const auto kind = std::ranges::find_if(kinds(), [&](const Kind& k) { return word == k.word; });
    bool any = false;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool named =
          kind != kinds().end() ? is_of(*kind, all[i].key) && all[i].number.get() != 0 : all[i].key == word;
      if (!named || (kind != kinds().end() && !is_in_equations(model, all[i]))) continue;
      any = chosen[i] = true;
      if (!is_in_equations(model, all[i])) fail_kind(model, kinds()[3]);
      if (all[i].number.get() == 0 && word.find(".coupling.") == word.npos)
        throw InputError(
            fmt::format("parameter {}: is 0 in {}, which gives no scale to look for it; write a guess into "
                        "the model",
                        in_quotes(word), model.source));
    }
    if (any) continue;
    if (kind != kinds().end()) fail_kind(model, *kind);
    fail_unknown(model, word, all);
  }
  std::vector<std::string> keys;
  std::vector<const ParameterInfo*> ratio(model.n(), nullptr);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!chosen[i]) continue;
    keys.push_back(all[i].key);
    if (!is_of_ratio(all[i])) continue;
    if (const ParameterInfo* other = std::exchange(ratio[all[i].joint], &all[i]))
      throw InputError(
          fmt::format("parameters {} and {}: a log tells only the ratio of a drive, in which both are; ask "
                      "for one of them",
                      other->key, all[i].key));
  }
  return keys;
}

}  // namespace halyard
