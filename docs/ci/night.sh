#!/usr/bin/env bash
# night.sh FOLDER: a night on one machine. Fuzzes, replays what is stored, and writes FOLDER/report. Exits with 1 when
# something gates, so that cron mails what was printed.
set -euo pipefail
folder=$1
corpus=$folder/corpus
mkdir -p "$folder"

# Exit code 1 says that something was found; the report says whether it gates.
found() { "$@" || [ $? -eq 1 ]; }

# Another seed each night; the same one when the night is run again.
seed=$(date -u +%Y%m%d)
found contort fuzz --time 6h --seed "$seed" --corpus "$corpus"
found contort replay "$corpus" --update --time 1h
contort corpus prune "$corpus"
contort report "$corpus" -o "$folder/report" --markdown "$folder/summary.md" --gate
