#pragma once
/// Recordings of real rigs that the tour diagnoses if they are available. Models and column maps are in the examples,
/// folder measured. The project must not distribute the recordings: measured/RIG/README.md gives the source of each.

#include <filesystem>
#include <string>
#include <vector>

namespace halyard {

struct Rig {
  std::string name;  ///< folder of its results
  std::string title;
  std::string folder;                 ///< name of the rig's sub-folder, in measured/ and in the folder of recordings
  std::string model;                  ///< file in measured/folder
  std::vector<std::string> training;  ///< files in the recordings' folder
  std::string holdout;                ///< file in the recordings' folder; empty: the last third of the training data
};

const std::vector<Rig>& measured_rigs();

/// True if all files of the rig are in the folder of recordings.
bool is_at_hand(const Rig& rig, const std::filesystem::path& recordings);

}  // namespace halyard
