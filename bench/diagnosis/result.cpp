#include "bench/diagnosis/result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "model/input_error.h"
#include "model/output_file.h"

namespace halyard::blind {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kWords[kKinds] = {"clean_exact", "clean_mistuned", "effect", "effect_mistuned",
                                        "form",        "outside",        "pair",   "each_effect"};

/// JSON has neither infinities nor NaN.
Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }
double number(const Json& j, double without) { return j.is_null() ? without : j.get<double>(); }

Json numbers(const std::vector<double>& all) {
  Json list = Json::array();
  for (const double x : all) list.push_back(number(x));
  return list;
}
std::vector<double> numbers(const Json& list) {
  std::vector<double> all;
  for (const Json& x : list) all.push_back(number(x, std::numeric_limits<double>::quiet_NaN()));
  return all;
}

/// Files count joints from 1; 0 is the arm.
Json to_json(const Place& p) { return {{"effect", p.effect}, {"joint", p.joint ? *p.joint + 1 : 0}}; }
Place place_from(const Json& j) {
  const int number = j.at("joint");
  return {j.at("effect"), number == 0 ? EffectPlace(kWholeArm) : number - 1};
}

}  // namespace

std::string word(Kind kind) { return kWords[static_cast<int>(kind)]; }

Kind kind_of(const std::string& text) {
  const auto found = std::find(std::begin(kWords), std::end(kWords), text);
  if (found == std::end(kWords))
    throw InputError(fmt::format("--kind: {}: expected all or one of {}", in_quotes(text), fmt::join(kWords, ", ")));
  return static_cast<Kind>(found - std::begin(kWords));
}

std::string label(const Place& p) { return p.joint ? fmt::format("{} of joint {}", p.effect, *p.joint + 1) : p.effect; }

bool right_first(const Result& r) {
  return !r.truth.empty() && !r.named.empty() && r.named[0].place == r.truth[0].place;
}

bool all_named(const Result& r) {
  return std::ranges::all_of(r.truth, [&](const TrueEffect& t) {
    return std::ranges::find(r.named, t.place, &Named::place) != r.named.end();
  });
}

bool admits_rest(const Result& r) { return r.verdict == "unknown" || (!r.named.empty() && !r.unexplained.empty()); }

bool is_right(const Result& r) {
  switch (r.kind) {
    case Kind::clean_exact:
    case Kind::clean_mistuned: return r.failure.empty() && r.named.empty();
    case Kind::outside: return admits_rest(r);
    case Kind::pair: return all_named(r);
    default: return right_first(r);
  }
}

bool right_or_alternative(const Result& r) {
  if (right_first(r)) return true;
  if (r.truth.empty() || r.named.empty() || r.named[0].alternatives.size() > 2) return false;
  return std::ranges::find(r.named[0].alternatives, r.truth[0].place) != r.named[0].alternatives.end();
}

std::filesystem::path result_path(const std::filesystem::path& folder, Kind kind, int index) {
  return folder / "trials" / fmt::format("{}-{:06}.json", word(kind), index);
}

void write_result(const std::filesystem::path& folder, const Result& r) {
  Json truth = Json::array(), named = Json::array();
  for (const TrueEffect& t : r.truth) {
    Json parameters = Json::object();
    for (const TrueParameter& p : t.parameters) parameters[p.name] = {{"value", number(p.value)}, {"acts", p.acts}};
    Json each = to_json(t.place);
    each.update(
        {{"form", t.form}, {"size", number(t.size)}, {"strength", number(t.strength)}, {"parameters", parameters}});
    truth.push_back(each);
  }
  for (const Named& n : r.named) {
    Json alternatives = Json::array(), parameters = Json::object();
    for (const Place& a : n.alternatives) alternatives.push_back(to_json(a));
    for (const Parameter& p : n.parameters)
      parameters[p.name] = {{"value", number(p.value)}, {"ci95", {number(p.lower), number(p.upper)}}};
    Json each = to_json(n.place);
    each.update({{"alternatives", alternatives}, {"parameters", parameters}});
    named.push_back(each);
  }
  const Json all = {
      {"kind", word(r.kind)},
      {"index", r.index},
      {"seed", r.seed},
      {"limit", r.limit},
      {"failure", r.failure},
      {"truth", truth},
      {"verdict", r.verdict},
      {"named", named},
      {"unexplained", r.unexplained},
      {"joint_position_rms",
       {{"before", numbers(r.before)}, {"after", numbers(r.after)}, {"true_model", numbers(r.true_model)}}},
      {"seconds", {{"wall", r.wall_s}, {"cpu", r.cpu_s}}}};
  write_file_whole(result_path(folder, r.kind, r.index), all.dump(1) + "\n");
}

Result read_result(const std::filesystem::path& path) {
  try {
    std::ifstream stream(path);
    const Json all = Json::parse(stream);
    Result r;
    r.kind = kind_of(all.at("kind"));
    r.index = all.at("index");
    r.seed = all.at("seed");
    r.limit = all.at("limit");
    r.failure = all.at("failure");
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (const Json& t : all.at("truth")) {
      TrueEffect truth{place_from(t), t.at("form"), number(t.at("size"), 0), number(t.at("strength"), kInfinity), {}};
      for (const auto& [name, p] : t.at("parameters").items())
        truth.parameters.push_back({name, number(p.at("value"), 0), p.at("acts")});
      r.truth.push_back(std::move(truth));
    }
    r.verdict = all.at("verdict");
    for (const Json& n : all.at("named")) {
      Named named{place_from(n), {}, {}};
      for (const Json& a : n.at("alternatives")) named.alternatives.push_back(place_from(a));
      for (const auto& [name, p] : n.at("parameters").items())
        named.parameters.push_back({name, number(p.at("value"), 0), number(p.at("ci95").at(0), -kInfinity),
                                    number(p.at("ci95").at(1), kInfinity)});
      r.named.push_back(std::move(named));
    }
    r.unexplained = all.at("unexplained").get<std::vector<int>>();
    const Json& rms = all.at("joint_position_rms");
    r.before = numbers(rms.at("before"));
    r.after = numbers(rms.at("after"));
    r.true_model = numbers(rms.at("true_model"));
    r.wall_s = all.at("seconds").at("wall");
    r.cpu_s = all.at("seconds").at("cpu");
    return r;
  } catch (const Json::exception& error) {
    throw InputError(path.string() + ": not a result of a blind trial (" + error.what() + "); remove the file");
  }
}

}  // namespace halyard::blind
