# source cmake/set_up.sh CONFIGURE_PRESET [BUILD_PRESET], from the project's root: installs what is missing, configures
# and, with a second preset, builds.
set -euo pipefail
source cmake/install_packages.sh
install_packages \
  g++ cmake ninja-build \
  libsimbody-dev libsundials-dev libeigen3-dev libtinyxml2-dev libcli11-dev libfmt-dev \
  nlohmann-json3-dev libtbb-dev libboost-math-dev libceres-dev libjs-chart.js libgtest-dev

# Again if the presets have changed since.
if [ ! "build/$1/build.ninja" -nt CMakePresets.json ]; then
  cmake --preset "$1" >build-configure.log 2>&1 || { cat build-configure.log; exit 1; }
  rm -f build-configure.log
fi
[ $# -lt 2 ] || cmake --build --preset "$2"
