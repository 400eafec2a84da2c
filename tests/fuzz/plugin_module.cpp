// An estimator's module whose table, answers and numbers are those of the fuzzer's input.
#include <cstring>
#include <stdexcept>
#include <vector>

#include "plugins/halyard_estimator.h"
#include "tests/fuzz/reader.h"

namespace {

halyard::fuzzing::Bytes input;
halyard_estimator_table table;
std::string name;
std::vector<std::string> outputs;
std::size_t n;  // joints

int answer(char* message, std::size_t size) {
  const std::uint8_t kind = input.byte();
  if (kind == 255) throw std::runtime_error(input.text(1000));
  if (kind == 254) throw 1;
  std::memset(message, input.byte(), std::min<std::size_t>(size, 4 * input.byte()));  // without a zero at its end
  return kind < 192 ? HALYARD_OK : kind - 208;
}

void fill(double* values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) values[i] = input.number();
}

void fill(halyard_estimate& estimate) {
  for (double* values : {estimate.joint_position, estimate.joint_velocity, estimate.joint_position_std})
    fill(values, n);
  fill(estimate.extra_outputs, outputs.size() * n);
}

int create(const halyard_config* config, void** instance, char* message, std::size_t size) {
  n = config->n_joints;
  if (input.byte() != 255) *instance = &table;
  return answer(message, size);
}

int reset(void*, const halyard_sample*, char* message, std::size_t size) { return answer(message, size); }

int update(void*, const halyard_sample*, halyard_innovation* innovation, char* message, std::size_t size) {
  const std::size_t m = input.byte() % (n + 1);
  fill(innovation->nu, m);
  fill(innovation->S_root, m * m);
  const std::uint8_t more = input.byte();
  innovation->m = more < 250 ? m : m << (8 * (more - 249));
  return answer(message, size);
}

int estimate(void*, halyard_estimate* estimate, char* message, std::size_t size) {
  fill(*estimate);
  return answer(message, size);
}

int report(void*, halyard_report* report, char* message, std::size_t size) {
  report->steps = input.byte() - 1;
  return answer(message, size);
}

const char* extra_output_name(void*, std::size_t i) {
  if (i < outputs.size()) return outputs[i].c_str();
  const std::uint8_t kind = input.byte();
  if (kind == 0) return nullptr;
  outputs.push_back(kind == 255 ? "joint_position" : input.text(80));
  return outputs.back().c_str();
}

int revise(void*, std::int32_t, double* time_s, halyard_estimate* estimate, char* message, std::size_t size) {
  const std::uint8_t kind = input.byte();
  if (kind != 0) {
    *time_s = kind < 128 ? 0.001 * (kind - 1) : input.number();
    fill(*estimate);
  }
  return answer(message, size);
}

}  // namespace

extern "C" HALYARD_EXPORT void take_input(const std::uint8_t* data, std::size_t size) {
  input = {data, size};
  outputs.clear();
  outputs.reserve(256);  // the host keeps pointers into the names
}

const halyard_estimator_table* halyard_estimator() {
  const std::uint8_t kind = input.byte(), missing = input.byte();
  name = input.text(80);
  table = {std::uint32_t(kind < 200 ? HALYARD_ESTIMATOR_INTERFACE : kind - 200),
           std::uint32_t(kind < 200 ? sizeof table : input.byte()),
           name.c_str(),
           "made by a fuzzer",
           create,
           [](void*) {},
           reset,
           update,
           estimate,
           report,
           extra_output_name,
           revise};
  switch (missing) {
    case 1: table.name = nullptr; break;
    case 2: table.description = nullptr; break;
    case 3: table.create = nullptr; break;
    case 4: table.report = nullptr; break;
    case 5: table.revise = nullptr; break;
    case 6: table.extra_output_name = nullptr; break;
    case 7: return nullptr;
    default: break;
  }
  return &table;
}
