#pragma once
/// A torque that acts late leaves a residual that looks like noise wherever the command does, and is removed before the
/// noise is estimated. Noise of the logged torque itself stays: it is not correlated with its own derivative.
///
///   e - d τ',   d = Σ Δe Δτ' / Σ Δτ'²,   Δx(t) = x(t) - x(t - 10 ms)
///
///   e    torque residual: command minus need, N m        τ'   rate of the command, N m/s
///   d    delay, s; of a first-order current loop its time constant
///
/// The difference Δ takes off what is slow, which follows the motion.

#include <vector>

namespace halyard {

/// The residual without what goes with the command's rate; one run for each record, samples `interval` apart. NaN stay
/// and do not count.
std::vector<std::vector<double>> delay_free(std::vector<std::vector<double>> residual,
                                            const std::vector<std::vector<double>>& command_rate, double interval);

}  // namespace halyard
