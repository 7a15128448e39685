# OpenXR: the loader, and Monado, a runtime whose headset is simulated. Sourced after vulkan.sh; everything here lives
# where the Vulkan it draws on does: on the machine, or in the sysroot.
#
# SWELL_XR=monado shows programs Monado, whatever runtime the machine has. Otherwise nothing is set: a simulated headset
# is what tests want, not people.
# shellcheck shell=bash disable=SC2034,SC2154

# What a program that may open a window or a headset loads at run time.
host_packages=(libopenxr-loader1 libx11-6 libx11-xcb1 libxcb1 libxcursor1 libxi6 libxrandr2 libxkbcommon0 libxkbcommon-x11-0)
monado_packages=(libopenxr1-monado monado-service openxr-layer-corevalidation)

# Brings what drawing needs, and where it can be had what windows and headsets need: who has a lavapipe already is not
# given another for want of the latter.
host_set_up() {
  [[ $SWELL_VULKAN == sysroot ]] || vulkan_set_up "${draw_packages[@]}"
  case $SWELL_VULKAN in
    sysroot) vulkan_set_up "${draw_packages[@]}" "${host_packages[@]}" ;;
    machine)
      command -v dpkg-query >/dev/null || return 0
      local missing
      mapfile -t missing < <(missing_packages "${host_packages[@]}")
      ((${#missing[@]})) || return 0
      if is_root && DEBIAN_FRONTEND=noninteractive apt_install "${missing[@]}"; then return 0; fi
      say "no window and no headset without ${missing[*]}; pictures need none of them"
      ;;
  esac
}

# Where Monado and its manifests are.
openxr_root() { if [[ $SWELL_VULKAN == sysroot ]]; then echo "$sysroot"; fi; }

# Exports what points programs at Monado, and SWELL_MONADO, its service, for whoever is to start one.
openxr_environment() {
  [[ ${SWELL_XR:-} ]] || return 0
  [[ $SWELL_XR == monado ]] || fail "SWELL_XR is '$SWELL_XR': it must be monado, or not be set"
  local root layers
  root=$(openxr_root)
  SWELL_MONADO=$root/usr/bin/monado-service
  XR_RUNTIME_JSON=$root/usr/share/openxr/1/openxr_monado.json
  [[ -x $SWELL_MONADO && -r $XR_RUNTIME_JSON ]] || fail "there is no Monado in ${root:-/}: $(openxr_missing)"
  # The caller's own layers are found first. A child of a wrapped program is wrapped again: nothing is said twice.
  layers=$root/usr/share/openxr/1/api_layers/explicit.d
  [[ :${XR_API_LAYER_PATH:-}: == *:$layers:* ]] || XR_API_LAYER_PATH=${XR_API_LAYER_PATH:+$XR_API_LAYER_PATH:}$layers
  export SWELL_MONADO XR_RUNTIME_JSON XR_API_LAYER_PATH
}

openxr_missing() {
  case $SWELL_VULKAN in
    sysroot) echo "run '$project/scripts/monado --set-up' once" ;;
    *) echo "install ${monado_packages[*]}, or set SWELL_VULKAN=sysroot" ;;
  esac
}
