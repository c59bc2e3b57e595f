#!/bin/bash
# SPDX-License-Identifier: MIT
# What scripts/generate and scripts/test share: packages, configuring, building. Sourced, not run.
# shellcheck disable=SC2034  # the lists are used by those scripts

# To build and run (Debian 12).
build_packages=(
  g++ cmake ninja-build git pkg-config
  libeigen3-dev libhdf5-dev libopenexr-dev libhwy-dev libcli11-dev libtomlplusplus-dev
  libfmt-dev libpng-dev libzstd-dev nlohmann-json3-dev
  libcairo2-dev fonts-dejavu-core libnlopt-cxx-dev libnlopt-dev
  python3-dev python3-numpy pybind11-dev
)
# To build the tests; readers, compilers and shells by others, which they check our files and
# snippets with; drivers without a GPU and a browser, which they run shaders on.
test_packages=(
  libgtest-dev libbenchmark-dev hdf5-tools openexr openscenegraph python3-h5py glslang-tools zsh fish
  libopenmpi-dev openmpi-bin
  libegl-dev libgles-dev libgl1-mesa-dri libvulkan-dev mesa-vulkan-drivers chromium
)

say() { echo "== $*" >&2; }

fail() {
  echo "$(basename "$0"): $*" >&2
  exit 1
}

# Prints what the script's own beginning says of it, where that is what the options ask for; before
# anything is installed or built.
help_if_asked() {
  local option
  for option in "$@"; do
    case $option in
      -h | --help)
        sed -n '3,/^set /{/^#/s/^# \{0,1\}//p}' "$0"
        exit 0
        ;;
    esac
  done
}

# Names the command that stopped a script.
report_errors() {
  trap 'echo "$(basename "$0"): stopped at line $LINENO: $BASH_COMMAND" >&2' ERR
}

# Those of the packages that are not installed.
missing_packages() {
  local package known
  # shellcheck disable=SC2016  # the format is dpkg-query's, not the shell's
  known=$(dpkg-query --show --showformat='${Package} ${db:Status-Status}\n' "$@" 2>/dev/null || true)
  for package in "$@"; do
    grep -qxF "$package installed" <<<"$known" || echo "$package"
  done
}

# Installs what is missing; touches neither the network nor sudo if nothing is.
install_packages() {
  command -v dpkg-query >/dev/null ||
    fail "needs a system with apt; elsewhere install the likes of: $*, then see CONTRIBUTING.md"
  local missing as_root=()
  mapfile -t missing < <(missing_packages "$@")
  ((${#missing[@]})) || return 0
  if ((EUID != 0)); then
    command -v sudo >/dev/null ||
      fail "these packages are missing, and neither root nor sudo is at hand to install them: ${missing[*]}"
    as_root=(sudo)
  fi
  say "installing ${missing[*]}"
  "${as_root[@]}" apt-get update -qq || fail "apt-get update failed"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null ||
    fail "apt-get could not install: ${missing[*]}"
}

# Installs a folder's packages for Node.js that tests run. Without them, those tests are skipped and
# say so.
install_node_packages() {
  local folder=$1
  [[ ! -d $folder/node_modules ]] || return 0
  say "installing the packages for Node.js of $folder"
  npm ci --prefix "$folder" --silent --no-audit --no-fund --ignore-scripts ||
    say "npm could not install them: their tests are skipped"
}

# Readers of our files, where npm is at hand; three.js, where there is a browser for it too.
install_node_readers() {
  command -v npm >/dev/null || return 0
  install_node_packages tests
  ! command -v chromium >/dev/null || install_node_packages examples/three
}

# Configures and builds a preset, or only the targets named after it; quiet unless it fails.
build_preset() {
  local preset=$1 targets=("${@:2}") log
  log=$(mktemp)
  say "building the $preset preset"
  if ! cmake --preset "$preset" >"$log" 2>&1 ||
    ! cmake --build --preset "$preset" "${targets[@]/#/--target=}" >>"$log" 2>&1; then
    cat "$log" >&2
    rm -f "$log"
    fail "could not build the $preset preset"
  fi
  rm -f "$log"
}
