# Which Vulkan programs run on, and why. Sourced after common.sh.
#
# SWELL_VULKAN names the choice, and a person may set it to have the last word:
#   gpu      the machine's own drivers, nothing touched
#   machine  the machine's own loader and lavapipe, Mesa 24 or newer
#   sysroot  Debian 13's loader and lavapipe, unpacked into $sysroot
# Lavapipe older than Mesa 24 is never chosen: Debian 12's (22.3.6) draws every view of a multiview pass into layer 0.
# shellcheck shell=bash disable=SC2034,SC2154

sysroot=$deps/sysroot
least_mesa=24
draw_packages=(libvulkan1 mesa-vulkan-drivers)
validation_packages=(vulkan-validationlayers)

# The loader a program of this machine would find.
machine_loader() {
  local library
  for library in /usr/lib/*-linux-gnu/libvulkan.so.1 /usr/lib64/libvulkan.so.1 /usr/lib/libvulkan.so.1 \
    /usr/local/lib/libvulkan.so.1; do
    [[ -e $library ]] && echo "$library" && return 0
  done
  return 1
}

# A device node somebody may open, with a name that only graphics hardware has.
gpu_node() {
  local node
  for node in /dev/dri/renderD* /dev/nvidia[0-9]* /dev/dxg; do
    [[ -r $node && -w $node ]] && echo "$node" && return 0
  done
  return 1
}

# Manifests of drivers (the argument is a pattern for the file's name) in the places the loader looks.
machine_drivers() {
  compgen -G "/usr/share/vulkan/icd.d/$1" || compgen -G "/etc/vulkan/icd.d/$1" || compgen -G "/usr/local/share/vulkan/icd.d/$1"
}
hardware_driver() { machine_drivers '*.json' | grep -v '/lvp_icd' | head -n 1 | grep .; }
lavapipe_driver() { machine_drivers 'lvp_icd.json' || machine_drivers "lvp_icd.$(uname -m).json"; }

# package_version NAME: upstream version of an installed Debian package.
package_version() {
  local version
  version=$(dpkg-query -W -f '${db:Status-Status} ${Version}' "$1" 2>/dev/null) || return 1
  [[ $version == 'installed '* ]] || return 1
  version=${version#installed }
  version=${version#*:}
  echo "${version%%-*}"
}
# missing_packages NAME...: those that are not installed.
missing_packages() {
  local package
  for package in "$@"; do package_version "$package" >/dev/null || echo "$package"; done
}
machine_mesa() { package_version mesa-vulkan-drivers; }
machine_mesa_will_do() {
  local version
  version=$(machine_mesa) && ((${version%%.*} >= least_mesa)) && machine_loader >/dev/null
}

# Whether this distribution's own packages are new enough to install.
distribution_will_do() (
  command -v apt-get >/dev/null && [[ -r /etc/os-release ]] || return 1
  # shellcheck source=/dev/null
  . /etc/os-release
  case ${ID:-} in
    debian) ((${VERSION_ID:-99} >= 13)) ;; # testing and unstable carry no number
    ubuntu) ((${VERSION_ID%%.*} >= 24)) ;; # 24.04 began with Mesa 24.0
    *) return 1 ;;
  esac
)

# vulkan_choose any|lavapipe: sets SWELL_VULKAN and vulkan_why, changes nothing on the machine.
vulkan_choose() {
  local node
  if [[ ${SWELL_VULKAN:-} ]]; then
    [[ $SWELL_VULKAN =~ ^(gpu|machine|sysroot)$ ]] ||
      fail "SWELL_VULKAN is '$SWELL_VULKAN': it must be gpu, machine or sysroot, or not be set"
    vulkan_why=${vulkan_why:-SWELL_VULKAN is set}
  elif [[ $1 == any ]] && node=$(gpu_node) && machine_loader >/dev/null && hardware_driver >/dev/null; then
    SWELL_VULKAN=gpu vulkan_why="$node, $(machine_loader) and $(hardware_driver) are there"
  elif machine_mesa_will_do; then
    SWELL_VULKAN=machine vulkan_why="$(vulkan_no_gpu "$1"); the machine's Mesa $(machine_mesa) is at least $least_mesa"
  elif [[ ! -e $sysroot/.ready ]] && distribution_will_do && is_root; then
    SWELL_VULKAN=machine vulkan_why="$(vulkan_no_gpu "$1"); the distribution has Mesa $least_mesa or newer to install"
  elif machine_mesa >/dev/null; then
    SWELL_VULKAN=sysroot vulkan_why="$(vulkan_no_gpu "$1"); the machine's Mesa $(machine_mesa) is older than $least_mesa"
  else
    SWELL_VULKAN=sysroot vulkan_why="$(vulkan_no_gpu "$1"); the machine has no lavapipe of its own"
  fi
  export SWELL_VULKAN
}

vulkan_no_gpu() {
  if [[ $1 == lavapipe ]]; then echo "tests draw on lavapipe everywhere"; else echo "no usable GPU"; fi
}

# vulkan_set_up PACKAGE...: brings what the choice lacks.
vulkan_set_up() {
  case $SWELL_VULKAN in
    gpu) return 0 ;;
    sysroot) "$project/scripts/sysroot-up" "$sysroot" "$@" ;;
    machine)
      # Where dpkg does not rule, the person who chose the machine's own Vulkan answers for it.
      command -v dpkg-query >/dev/null || return 0
      local missing
      mapfile -t missing < <(missing_packages "$@")
      ((${#missing[@]})) || return 0
      if is_root && DEBIAN_FRONTEND=noninteractive apt_install "${missing[@]}"; then return 0; fi
      say "${missing[*]} cannot be installed here; unpacking Debian 13's instead"
      SWELL_VULKAN=sysroot
      "$project/scripts/sysroot-up" "$sysroot" "$@"
      ;;
  esac
}

# One line on what programs will meet.
vulkan_describe() {
  case $SWELL_VULKAN in
    gpu) echo "the machine's own drivers" ;;
    machine) echo "the machine's own lavapipe, Mesa $(machine_mesa || echo 'of unknown version')" ;;
    sysroot)
      if [[ -e $sysroot/.ready ]]; then
        echo "lavapipe, Mesa $(<"$sysroot/mesa-version"), in $sysroot"
      else
        echo "lavapipe of Debian 13, to be unpacked into $sysroot"
      fi
      ;;
  esac
}
