#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tests/kernels/oclgrind.sh PROGRAM: the kernels of small runs under Oclgrind, which finds races and memory out of
# bounds. Some three minutes. Without the compiler's optimisations: of these Oclgrind 21.10 does not know
# llvm.bitreverse. Without --uninitialized, which in that version stops at every sincos, and takes what atomics add to a
# buffer that the host filled for uninitialized.
set -euo pipefail
program=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

small=(--passes 2 --set "scene.camera.resolution=[8,6]" --set spectral.photons_per_pass=64)
check() {
  local status=0
  oclgrind --data-races --max-errors 20 --build-options -cl-opt-disable --log "$work/log" \
    "$program" run "$@" "${small[@]}" -o "$work/run" >"$work/out" 2>&1 || status=$?
  if [ "$status" -ne 0 ] || [ -s "$work/log" ]; then
    echo "oclgrind: $1 (exit status $status)"
    head -n 60 "$work/log"
    tail -n 5 "$work/out"
    return 1
  fi
}

check first-light
check spectral/glass-in-a-room --set spectral.indirect_photons_per_pass=64 # photon maps, indirect light
check first-light --set spectral.estimator=tiles
check spectral/three-lamps                                                 # an environment
check spectral/evening-sun                                                 # one with even light
check spectral/prism --set spectral.relight=true                           # a layer a light and cluster
check extremes/nested-eight                                                # spheres
small=(--passes 1 --set "inverse.facets=[2,2]" --set "inverse.size_mm=[10,10]" --set "inverse.receiver_mm=[20,20]"
  --set "inverse.cells=[4,3]"
  --set "scene.camera.resolution=[64,64]")
# Facets and their judge, nothing left out.
check inverse/tilted --set inverse.sun_deg=0.5 --set inverse.smoothing_normals=0.1
