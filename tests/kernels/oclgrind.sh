#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tests/kernels/oclgrind.sh PROGRAM: the kernels of small runs under Oclgrind, which finds races and memory out of
# bounds. It looks with one thread, so two runs go at a time. Without the compiler's optimisations: of these Oclgrind
# 21.10 does not know llvm.bitreverse. Without --uninitialized, which in that version stops at every sincos, and takes
# what atomics add to a buffer that the host filled for uninitialized.
set -euo pipefail
export program=$1

# check 'PRESET OPTION...'
check() {
  local status=0 work words
  work=$(mktemp -d)
  read -ra words <<<"$1"
  oclgrind --data-races --max-errors 20 --build-options -cl-opt-disable --log "$work/log" \
    "$program" run "${words[@]}" -o "$work/run" >"$work/out" 2>&1 || status=$?
  if [ "$status" -ne 0 ] || [ -s "$work/log" ]; then
    echo "oclgrind: $1 (exit status $status)"
    [ ! -f "$work/log" ] || head -n 60 "$work/log"
    tail -n 5 "$work/out"
    status=1
  fi
  rm -rf "$work"
  return "$status"
}
export -f check

rays='--passes 2 --set scene.camera.resolution=[8,6] --set spectral.photons_per_pass=64'
facets='--passes 1 --set inverse.facets=[2,2] --set inverse.size_mm=[10,10] --set inverse.receiver_mm=[20,20]
  --set inverse.cells=[4,3] --set scene.camera.resolution=[64,64]'
runs=(
  "first-light $rays"
  "spectral/glass-in-a-room $rays --set spectral.indirect_photons_per_pass=64" # photon maps, indirect light
  "first-light $rays --set spectral.estimator=tiles"
  "spectral/three-lamps $rays"                             # an environment
  "spectral/evening-sun $rays"                             # one with even light
  "spectral/prism $rays --set spectral.relight=true"       # a layer a light and cluster
  "extremes/nested-eight $rays"                            # spheres
  "inverse/tilted ${facets//$'\n'/} --set inverse.sun_deg=0.5 --set inverse.smoothing_normals=0.1" # nothing left out
)
# shellcheck disable=SC2016 # its own shell has $1
printf '%s\n' "${runs[@]}" | xargs -d '\n' -P 2 -I{} bash -c 'check "$1"' check {}
