#!/usr/bin/env bash
#SBATCH --job-name=contort
#SBATCH --array=0-15
#SBATCH --cpus-per-task=2
#SBATCH --requeue
# A run over 16 tasks of a Slurm array: sbatch docs/scale/slurm.sh FOLDER [OPTIONS of contort fuzz].
# Slurm's variables say which shard a task is. A task that is requeued goes on where it was killed. Afterwards:
#   contort merge FOLDER/shard-* -o FOLDER/corpus --require-complete
set -euo pipefail
folder=$1
contort fuzz --cases "${CASES:-100000}" --seed "${SEED:-1}" --jobs "$SLURM_CPUS_PER_TASK" --resume \
  --corpus "$folder/shard-$SLURM_ARRAY_TASK_ID" "${@:2}" || [ $? -eq 1 ]
