#!/bin/sh
# An array job of Slurm: each task renders one shard of `alberti batch`.
#
#   sbatch --array=0-255%64 deploy/slurm/batch.sh --list jobs.jsonl --out-dir OUT --size 512x512
#
# The arguments are those of `alberti batch`, the same for every task. A task is best as large as a node, and
# about four times as many tasks as run at a time (%64) keep unequal nodes busy to the end. The output folder and
# the models must be on a file system that all nodes share.
#
# A task that loses its node is started again by Slurm and continues where it was. Submitting the same
# command again does only what is missing. Afterwards, anywhere:
#
#   alberti batch --list jobs.jsonl --out-dir OUT --size 512x512 --merge     one report of all shards
#   alberti batch --list jobs.jsonl --out-dir OUT --size 512x512 --verify    is all there and whole?
#
#SBATCH --job-name=alberti
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --nodes=1
#SBATCH --ntasks=1

# Cores of the task; without --cpus-per-task those of the node.
${ALBERTI:-alberti} batch --shard auto ${SLURM_CPUS_PER_TASK:+--threads "$SLURM_CPUS_PER_TASK"} "$@"
code=$?

# The place failed, not a model (3): full disk, lost file system. Another node may do better.
if [ "$code" = 3 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 3 ]; then
  scontrol requeue "${SLURM_ARRAY_JOB_ID}_${SLURM_ARRAY_TASK_ID}" && exit
fi
exit "$code"
