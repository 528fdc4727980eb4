#!/usr/bin/env python3
"""Runs the points of a sweep with HyperQueue: python3 run_hyperqueue.py commands.json CORES THREADS

commands.json is a list of commands, each a list of words. The tasks run on a local cluster of CORES cores, THREADS each; with
HQ_SERVER_DIR set, on the workers of that server. Exit code: 0, all tasks succeeded; 3, some failed; else the driver failed.
"""
import json
import os
import sys

from hyperqueue import Job, LocalCluster
from hyperqueue.client import Client
from hyperqueue.cluster import WorkerConfig
from hyperqueue.ffi.protocol import ResourceRequest


def run(client, commands, threads):
    job = Job(max_fails=None)
    for command in commands:
        job.program(command, stdout=None, stderr=None, resources=ResourceRequest(cpus=threads))
    submitted = client.submit(job)
    if client.wait_for_jobs([submitted], raise_on_error=False):
        return 0
    for task, failure in sorted(client.get_failed_tasks(submitted).items()):
        print(f"{' '.join(commands[task])}: {failure.error}", file=sys.stderr)
    return 3


def main():
    commands = json.load(open(sys.argv[1], encoding="utf-8"))
    cores, threads = int(sys.argv[2]), int(sys.argv[3])
    if not commands:
        return 0
    if server := os.environ.get("HQ_SERVER_DIR"):
        return run(Client(server), commands, threads)
    with LocalCluster(worker_config=WorkerConfig(cores=cores)) as cluster:
        return run(cluster.client(), commands, threads)


if __name__ == "__main__":
    sys.exit(main())
