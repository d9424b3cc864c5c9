#!/bin/bash
# A survey as an array of jobs under Slurm: sbatch scenes/surveys/slurm.sh SURVEY.toml FOLDER
# FOLDER is on a file system that all nodes share. Jobs that were cut off go on where they were when they are submitted again.
#SBATCH --job-name=kerrscope-survey
#SBATCH --array=1-16
#SBATCH --cpus-per-task=8
#SBATCH --time=04:00:00
set -euo pipefail
survey=$1
folder=$2
kerrscope survey run "$survey" --folder "$folder" \
    --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --threads "$SLURM_CPUS_PER_TASK"
# Afterwards, once: kerrscope survey merge "$survey" --folder "$folder" -o library.h5
