#!/bin/sh
# A Slurm array job: each task renders one shard of `alberti batch`.
#
#   sbatch --array=0-255%64 deploy/slurm/batch.sh --list jobs.jsonl --out-dir OUT --size 512x512
#
# The arguments are passed to `alberti batch`, unchanged for every task. It is best if a task fills a node, and
# if there are about four times as many tasks as run at a time (%64), so that unequal nodes stay busy until the
# end. The output folder and the models must be on a file system that all nodes share.
#
# Slurm restarts a task that loses its node, and the task resumes where it stopped. Submitting the same command
# again renders only what is missing. Afterwards, on any machine:
#
#   alberti batch --list jobs.jsonl --out-dir OUT --size 512x512 --merge     write one report for all shards
#   alberti batch --list jobs.jsonl --out-dir OUT --size 512x512 --verify    check that all pictures are intact
#
#SBATCH --job-name=alberti
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --nodes=1
#SBATCH --ntasks=1

# The cores of the task or, without --cpus-per-task, of the node.
${ALBERTI:-alberti} batch --shard auto ${SLURM_CPUS_PER_TASK:+--threads "$SLURM_CPUS_PER_TASK"} "$@"
code=$?

# Exit code 3: the machine failed, not a model: full disk, lost file system. Another node may succeed.
if [ "$code" = 3 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 3 ]; then
  scontrol requeue "${SLURM_ARRAY_JOB_ID}_${SLURM_ARRAY_TASK_ID}" && exit
fi
exit "$code"
