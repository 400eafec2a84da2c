#pragma once
/// What a residual that no candidate explains looks like.

#include "diagnosis/evidence.h"

namespace halyard {

/// One sentence for joint k (0-based): the size of the rest on the training records, and with which of position, rate,
/// direction, acceleration or a constant it goes together most.
std::string signature(const Evidence& evidence, const Hypothesis& hypothesis, int joint);

/// True if every record moves joint k along one and the same sine: a fit of one sine cannot tell effects apart.
bool is_one_sinusoid(const std::vector<Record>& records, int joint);

}  // namespace halyard
