#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The lines of app/ and ui/ that name an engine outside of what is the engine's own, its folders: by namespace, by
# include, by a name in a text. Comments do not count, nor does the environment of a scene, nor app/photons, whose
# settings are the section "spectral" of a preset. tests/unit/includes_test.cpp says how many there may be.
cd "$(dirname "$0")/../.." || exit 1
engines=$(sed -n 's|^#include "\([a-z]*\)/engine.h"|\1|p' app/engines.cpp | paste -sd'|')
names="\b($engines)::|::($engines)\b|\"(ui/|cli/)?($engines)/|\"($engines)[\".]|(--set|instance|Sets) ($engines)\."
names="$names|engine [\"\\\\]*($engines)\b|engine [123]\b"
names="$names|\b($engines)_panels|: ($engines)\"|\b($engines) (run|preset)|(run|plan|segment) ($engines)/"
grep -rE --include='*.h' --include='*.cpp' -n '' app ui | sed 's|//.*||' | grep -vE "^[^:]*/($engines)/" |
  grep -E "$names" |
  grep -vE '^app/photons/|glm::inverse|^app/(scene|tracing|preset)/.*"environment"' |
  grep -vE 'scene[./]environment|Kind::environment'
