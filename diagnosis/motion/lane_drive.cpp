#include "diagnosis/motion/lane_drive.h"

#include "transmission/lanes/instruction_set.h"

namespace halyard {

extern const LaneDrive kDrive_generic;
#if defined(HALYARD_WIDE_LANES)
extern const LaneDrive kDrive_avx2, kDrive_avx512;
#endif

const std::vector<LaneDrive>& lane_drives() {
#if defined(HALYARD_WIDE_LANES)
  static const std::vector<LaneDrive> usable =
      usable_copies<LaneDrive>({&kDrive_generic, &kDrive_avx2, &kDrive_avx512});
#else
  static const std::vector<LaneDrive> usable = usable_copies<LaneDrive>({&kDrive_generic});
#endif
  return usable;
}

}  // namespace halyard
