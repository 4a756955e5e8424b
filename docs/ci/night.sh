#!/usr/bin/env bash
# night.sh FOLDER: a night on one machine. Fuzzes, replays what is stored, and writes FOLDER/report. Exits with 1 when
# something gates, so that cron mails what was printed, and with 4 or 2 when something was not the same twice or could
# not be read.
set -euo pipefail
folder=$1
corpus=$folder/corpus
mkdir -p "$folder"

# That something was found is the report's to judge (1). What was not the same twice (4) and what does not build any more
# (2) must not keep the rest of the night from being reported. All else, a full disk for instance, ends it.
late=0
go_on() {
  local code=0
  "$@" || code=$?
  case $code in
    0 | 1) ;;
    2 | 4) late=$code ;;
    *) exit "$code" ;;
  esac
}

# Another seed each night; the same one when the night is run again.
seed=$(date -u +%Y%m%d)
go_on contort fuzz --time 6h --seed "$seed" --corpus "$corpus"
go_on contort replay "$corpus" --update --time 1h
contort corpus prune "$corpus"
go_on contort explain "$corpus" >"$folder/conditions.txt"
contort report "$corpus" -o "$folder/report" --markdown "$folder/summary.md" --gate
exit "$late"
