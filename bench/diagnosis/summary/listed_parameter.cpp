#include "bench/diagnosis/summary/listed_parameter.h"

#include <map>
#include <utility>

#include "diagnosis/search_space.h"
#include "model/model_file.h"

namespace halyard::blind {
namespace {

using Listed = std::map<std::pair<std::string, std::string>, ListedParameter>;

Listed list_parameters() {
  const ArmModel raven2 = read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml");
  Listed listed;
  for (const Effect* effect : effect_library())
    for (const EffectPlace joint : effect_places(*effect, raven2.nominal)) {
      const std::vector<EffectParameter> parameters = effect->parameters(raven2.nominal, joint);
      const SearchSpace space = search_space(*effect, raven2.nominal, joint);
      for (std::size_t i = 0; i < parameters.size(); ++i)
        listed.insert({{effect->name(), parameters[i].name}, {parameters[i].neutral, space.parameters[i].is_whole}});
    }
  return listed;
}

}  // namespace

ListedParameter listed_parameter(const std::string& effect, const std::string& parameter) {
  static const Listed listed = list_parameters();
  const auto found = listed.find({effect, parameter});
  return found == listed.end() ? ListedParameter() : found->second;
}

}  // namespace halyard::blind
