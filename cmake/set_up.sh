# Sourced by ./run and ./test from the project's root: installs what is missing, configures and builds the build preset
# that is named: program (the program and what it loads) or release (the tests and examples too).
set -euo pipefail

packages=(
  g++ cmake ninja-build
  libsimbody-dev libsundials-dev libeigen3-dev libtinyxml2-dev libcli11-dev libfmt-dev
  nlohmann-json3-dev libtbb-dev libboost-math-dev libceres-dev libjs-chart.js libgtest-dev
)

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
done
if [ ${#missing[@]} -gt 0 ]; then
  echo "halyard: installing ${missing[*]}"
  as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "halyard: installing packages needs root: run 'apt-get install ${missing[*]}' as root, then this again" >&2; exit 1; }
    as_root=(sudo)
  fi
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
fi

if [ ! -f build/release/build.ninja ]; then
  cmake --preset release >build-configure.log 2>&1 || { cat build-configure.log; exit 1; }
  rm -f build-configure.log
fi
cmake --build --preset "$1"
