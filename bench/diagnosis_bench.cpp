#include <benchmark/benchmark.h>

#include "bench/bench_arm.h"
#include "diagnosis/prediction/prediction.h"

namespace halyard {
namespace {

void predict_hypotheses(benchmark::State& state) {
  const ArmModel model = raven2();
  static const Record record = make_records(simulate(sines(model, 4)).measured, model, {})[0];
  std::vector<Hypothesis> all(static_cast<std::size_t>(state.range(0)), Hypothesis{model.nominal, {}});
  for (std::size_t i = 0; i < all.size(); ++i) all[i].nominal.joint[1].mass *= 1 + 1e-3 * static_cast<double>(i);
  for (auto _ : state) benchmark::DoNotOptimize(predict(record, all, 10));
}
// A batch of lanes, and enough batches for the threads that there are.
BENCHMARK(predict_hypotheses)->Name("Predict")->Arg(1)->Arg(8)->Arg(64)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace halyard
