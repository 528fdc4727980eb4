#!/bin/bash
#SBATCH --job-name={name}
#SBATCH --array=1-{tasks}
#SBATCH --cpus-per-task={threads}
#SBATCH --output={folder}/slurm-%a.txt
# {points} points of a sweep, {per_task} for each task of the array. Submit with sbatch; then run the sweep again for its tables.
first=$(( (SLURM_ARRAY_TASK_ID - 1) * {per_task} + 1 ))
last=$(( SLURM_ARRAY_TASK_ID * {per_task} ))
failed=0
while read -r point; do
    {program} sweep {quoted_folder} --point "$point" --threads {threads} --quiet </dev/null || failed=1
done < <(sed -n "${{first}},${{last}}p" {ids})
exit "$failed"
