#include "diagnosis/explanation/lines_above_band.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/explanation/view_sentence.h"

namespace halyard {
namespace {

struct ChannelLine {
  NoiseLine line;
  int channel;
  double height;  ///< over the channel's floor
};

std::vector<ChannelLine> highest_of_each(const Evidence& evidence, const std::vector<ChannelNoise>& noise) {
  constexpr double kSameLine = 1.5;  // Hz
  std::vector<ChannelLine> all;
  for (int c = 0; c < evidence.channels(); ++c)
    for (const NoiseLine& line : noise[c].lines) {
      const ChannelLine now{line, c, line.amplitude / evidence.floor()[c]};
      if (now.height < 1) continue;
      const auto same = std::ranges::find_if(
          all, [&](const ChannelLine& l) { return std::abs(l.line.frequency - line.frequency) < kSameLine; });
      if (same == all.end()) all.push_back(now);
      else if (same->height < now.height) *same = now;
    }
  return all;
}

}  // namespace

std::vector<Unexplained> lines_above_band(const Evidence& evidence, const Hypothesis& revised) {
  std::vector<Unexplained> told;
  std::vector<ChannelLine> lines = highest_of_each(evidence, evidence.noise());
  // What the model as given leaves above the band may have a cause below it: a controller that rings behind a delay.
  if (!lines.empty() && !revised.effects.empty())
    lines = highest_of_each(evidence, channel_noise(evidence.records(), revised));
  const ArmParameters<double>& arm = revised.nominal;
  for (const ChannelLine& l : lines) {
    const int k = l.channel % arm.n;
    const ResidualKind kind = l.channel < arm.n ? ResidualKind::motor_torque : ResidualKind::joint_position;
    told.push_back({k,
                    fmt::format("the {} contains a sine of {:.0f} Hz with an amplitude of {}: hum, a resonance or "
                                "chatter, above the frequencies that are compared",
                                residual_name(arm, k, kind), l.line.frequency,
                                shown(l.line.amplitude, residual_unit(arm, k, kind))),
                    Unexplained::Kind::line_above_band});
  }
  return told;
}

}  // namespace halyard
