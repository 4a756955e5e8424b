#!/usr/bin/env bash
# panel_test.sh PROJECT BINARIES: a report with the engine, opened from the disk in Chromium: the values of a case are
# changed there, and motion and margins change with them.
set -euo pipefail

project=$1
binaries=$2
# shellcheck source=tests/page/browser.sh
source "$project/tests/page/browser.sh" npm node em++
cd "$project"
cmake --preset wasm >"$scratch/configure.log" || { cat "$scratch/configure.log"; exit 1; }
cmake --build build/wasm >"$scratch/build.log" || { tail -n 50 "$scratch/build.log"; exit 1; }

# A build with the option CONTORT_ENGINE has the engine beside the program.
cp -r "$binaries/contort" "$binaries/contort-render" "$binaries/page" "$scratch/"
cp build/wasm/engine.js "$scratch/page/"
"$scratch/contort" fuzz --profile smoke --cases 0 --seeds tests/page/seeds --corpus "$scratch/corpus" >/dev/null ||
  [ $? -eq 1 ]
"$scratch/contort" --gl none report "$scratch/corpus" -o "$scratch/report" --single-file "$scratch/report.html"

# The same with what a run may have beside: actions of one's own, one of which is a script, and settings.
mkdir "$scratch/library" "$scratch/wave"
cp docs/examples/own_actions/{wave,breathe}.json "$scratch/library/"
cat >"$scratch/settings.json" <<'END'
{"format": "contort.settings/1",
 "limits": [{"check": "angular_velocity", "subject": "*", "tolerance": 1.5, "reason": "a quick one"}]}
END
cat >"$scratch/wave/wave.json" <<'END'
{"format": "contort.spec/1", "character": {"name": "human"}, "hold_frames": 10,
 "sequences": [{"clips": [{"actions": [
  {"action": "wave", "slot": "arm_right", "duration_frames": 30},
  {"action": "pose", "slot": "arm_left", "start_frame": 10, "duration_frames": 0, "params": {"elbow_deg": 100}}]}]}]}
END
own=(--library "$scratch/library" --settings "$scratch/settings.json")
"$scratch/contort" "${own[@]}" fuzz --profile smoke --cases 0 --seeds "$scratch/wave" --corpus "$scratch/own_corpus" \
  --shrink-evaluations 0 >/dev/null || [ $? -eq 1 ]
"$scratch/contort" --gl none "${own[@]}" report "$scratch/own_corpus" -o "$scratch/own"

export CONTORT_PAGE_TEST="{\"modules\": \"$modules/node_modules\", \"chromium\": \"$chromium\",
  \"report\": \"$scratch/report\", \"contort\": \"$scratch/contort\", \"corpus\": \"$scratch/corpus\",
  \"single\": \"$scratch/report.html\", \"own\": \"$scratch/own\"}"
node --test-reporter=spec tests/wasm/panel.test.mjs
