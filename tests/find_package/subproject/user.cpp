#include <cstdio>

#include "halyard/version.h"
#include "model/arm_model.h"

int main() { std::printf("halyard %s, %d joints\n", halyard::kVersion, halyard::ArmModel().n()); }
