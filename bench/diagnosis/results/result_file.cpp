#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "bench/diagnosis/results/result.h"
#include "model/input/text_file.h"
#include "model/input_error.h"
#include "model/output/output_files.h"

namespace halyard::blind {
namespace {

using Json = nlohmann::ordered_json;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// JSON has neither infinities nor NaN.
Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }
double number(const Json& j, double without) { return j.is_null() ? without : j.get<double>(); }

Json maybe(const std::optional<double>& x) { return x ? number(*x) : Json(nullptr); }
std::optional<double> maybe(const Json& j) { return j.is_null() ? std::nullopt : std::optional(j.get<double>()); }

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

Json to_json(const Place& p) { return {{"effect", p.effect}, {"joint", p.joint}}; }
Place place_from(const Json& j) { return {j.at("effect"), j.at("joint")}; }

Json to_json(const Situation& s) {
  return {{"kind", word(s.kind)}, {"sensors", word(s.sensors)}, {"off", s.off}, {"arms", word(s.arms)}};
}
Situation situation_from(const Json& j) {
  return {kind_of(j.at("kind")), sensors_of(j.at("sensors")), j.at("off"), arms_of(j.at("arms"))};
}

Json to_json(const TrueEffect& t) {
  Json parameters = Json::object();
  for (const TrueParameter& p : t.parameters) parameters[p.name] = {{"value", number(p.value)}, {"acts", p.acts}};
  Json each = to_json(t.place);
  each.update({{"form", t.form},
               {"size", number(t.size)},
               {"seen_from", number(t.seen_from)},
               {"named_from", number(t.named_from)},
               {"parameters", std::move(parameters)}});
  return each;
}
TrueEffect truth_from(const Json& j) {
  TrueEffect t{place_from(j),
               j.at("form"),
               number(j.at("size"), 0),
               number(j.at("seen_from"), kInfinity),
               number(j.at("named_from"), kInfinity),
               {}};
  for (const auto& [name, p] : j.at("parameters").items())
    t.parameters.push_back({name, number(p.at("value"), 0), p.at("acts")});
  return t;
}

Json to_json(const Named& n) {
  Json alternatives = Json::array(), parameters = Json::object();
  for (const Alternative& a : n.alternatives) {
    alternatives.push_back(to_json(a.place));
    alternatives.back().update({{"probability", number(a.probability)}, {"in_set", a.in_set}});
  }
  for (const Parameter& p : n.parameters)
    parameters[p.name] = {{"value", number(p.value)}, {"ci95", {number(p.lower), number(p.upper)}}};
  Json each = to_json(n.place);
  each.update({{"probability", number(n.probability)},
               {"alternatives", std::move(alternatives)},
               {"parameters", std::move(parameters)}});
  return each;
}
Named named_from(const Json& j) {
  Named n{place_from(j), number(j.at("probability"), 0), {}, {}};
  for (const Json& a : j.at("alternatives"))
    n.alternatives.push_back({place_from(a), number(a.at("probability"), 0), a.at("in_set")});
  for (const auto& [name, p] : j.at("parameters").items())
    n.parameters.push_back({name, number(p.at("value"), 0), number(p.at("ci95").at(0), -kInfinity),
                            number(p.at("ci95").at(1), kInfinity)});
  return n;
}

template <class Things>
Json list_of(const Things& things) {
  Json list = Json::array();
  for (const auto& thing : things) list.push_back(to_json(thing));
  return list;
}

Json to_json(const HoldOutErrors& e) {
  return {{"before", numbers(e.before)},
          {"after", numbers(e.after)},
          {"true_model", numbers(e.true_model)},
          {"informed", numbers(e.informed)},
          {"rise", numbers(e.rise)}};
}
HoldOutErrors holdout_from(const Json& j) {
  return {numbers(j.at("before")), numbers(j.at("after")), numbers(j.at("true_model")), numbers(j.at("informed")),
          numbers(j.at("rise"))};
}

Result result_from(const Json& all) {
  Result r;
  r.situation = situation_from(all.at("situation"));
  r.index = all.at("index");
  r.seed = all.at("seed");
  r.failure = all.at("failure");
  if (all.contains("dropped_draws")) r.dropped = all.at("dropped_draws").get<std::vector<std::string>>();
  r.arm = all.at("arm");
  r.joints = all.at("joints");
  r.latency_s = all.at("sensors").at("latency_s");
  r.joint_rate_hz = all.at("sensors").at("joint_rate_hz");
  r.outliers = all.at("sensors").at("outliers");
  r.rule = all.value("rule", "");
  r.program = all.value("program", "");
  for (const Json& t : all.at("truth")) r.truth.push_back(truth_from(t));
  for (const Json& p : all.at("also_true")) r.also_true.push_back(place_from(p));
  r.verdict = all.at("verdict");
  for (const Json& n : all.at("named")) r.named.push_back(named_from(n));
  r.unexplained = all.at("unexplained").get<std::vector<int>>();
  r.probability_clean = maybe(all.at("probability_clean"));
  r.probability_none = maybe(all.at("probability_none"));
  r.holdout = holdout_from(all.at("joint_position_rms"));
  r.sensed_holdout = holdout_from(all.at("joint_position_rms_as_sensed"));
  if (all.contains("joint_position_interval95"))
    r.interval_coverage = numbers(all.at("joint_position_interval95").at("coverage"));
  r.wall_s = all.at("seconds").at("wall");
  return r;
}

Json to_json(const Result& r) {
  Json all = {{"situation", to_json(r.situation)},
              {"index", r.index},
              {"seed", r.seed},
              {"failure", r.failure},
              {"arm", r.arm},
              {"joints", r.joints},
              {"sensors", {{"latency_s", r.latency_s}, {"joint_rate_hz", r.joint_rate_hz}, {"outliers", r.outliers}}},
              {"truth", list_of(r.truth)},
              {"also_true", list_of(r.also_true)},
              {"verdict", r.verdict},
              {"named", list_of(r.named)},
              {"unexplained", r.unexplained},
              {"probability_clean", maybe(r.probability_clean)},
              {"probability_none", maybe(r.probability_none)},
              {"joint_position_rms", to_json(r.holdout)},
              {"joint_position_rms_as_sensed", to_json(r.sensed_holdout)},
              {"seconds", {{"wall", r.wall_s}}}};
  if (!r.rule.empty()) all["rule"] = r.rule;
  if (!r.program.empty()) all["program"] = r.program;
  if (r.dropped) all["dropped_draws"] = *r.dropped;
  if (r.interval_coverage) all["joint_position_interval95"] = {{"coverage", numbers(*r.interval_coverage)}};
  return all;
}

}  // namespace

std::string label(const Place& p) { return p.joint == 0 ? p.effect : fmt::format("{} of joint {}", p.effect, p.joint); }

std::filesystem::path result_path(const std::filesystem::path& folder, const Situation& situation, int index) {
  return folder / "trials" / fmt::format("{}-{:06}.json", label(situation), index);
}

void write_result(const std::filesystem::path& folder, const Result& r) {
  write_file_whole(result_path(folder, r.situation, r.index), to_json(r).dump(1) + "\n");
}

std::string result_line(const Result& r) { return to_json(r).dump(); }

Result read_result(const std::filesystem::path& path) {
  const std::string text =
      read_text_file(path, {.name = "a result of a blind trial", .if_too_large = "remove the file", .is_input = false});
  try {
    return result_from(Json::parse(text));
  } catch (const Json::exception& error) {
    throw InputError(path.string() + ": not a result of a blind trial (" + error.what() + "); remove the file");
  }
}

std::vector<Result> read_result_lines(const std::filesystem::path& path) {
  std::ifstream stream(path);
  if (!stream) throw InputError(path.string() + ": cannot be read; give a file with a line for each trial");
  std::vector<Result> results;
  for (std::string line; std::getline(stream, line);) {
    try {
      results.push_back(result_from(Json::parse(line)));
    } catch (const Json::exception& error) {
      throw InputError(fmt::format("{}:{}: not a result of a blind trial ({}); remove the line", path.string(),
                                   results.size() + 1, error.what()));
    }
  }
  return results;
}

}  // namespace halyard::blind
