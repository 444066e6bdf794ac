#!/usr/bin/env python3
"""The shards of lyrefit batch as tasks of Dask (Debian: python3-distributed).

    dask_example.py INPUT... --out OUT --shards N [--scheduler ADDRESS] [-- OPTION OF lyrefit batch...]

Without --scheduler it starts a cluster of --workers processes on this machine. INPUT and OUT must be seen by
every worker; relative paths begin in the folder that this is started in, where a worker sees it. What a worker had begun when it was killed is given to another one, which goes on where it
stopped; a shard that fails is tried once more, and then the run ends with what it said.
"""

import argparse
import os
import subprocess
import sys

from distributed import Client, LocalCluster, as_completed


def run_shard(folder, lyrefit, inputs, out, k, shards, options):
    """Runs one shard. It ends with the worker, so that another worker finds the shard free."""
    command = ["setpriv", "--pdeathsig", "KILL", lyrefit, "batch", *inputs, "--shard", f"{k}/{shards}",
               "--out", f"{out}/shards", "--resume", *options]
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                          cwd=folder if os.path.isdir(folder) else None)
    if done.returncode != 0:
        raise RuntimeError(f"shard {k} of {shards}: exit code {done.returncode}: {done.stderr.strip()[-500:]}")
    return k


def main():
    own, options = sys.argv[1:], ["--threads", "1"]
    if "--" in own:
        own, options = own[: own.index("--")], options + own[own.index("--") + 1 :]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("inputs", nargs="+", metavar="INPUT")
    parser.add_argument("--out", required=True)
    parser.add_argument("--shards", type=int, required=True, help="two at least")
    parser.add_argument("--scheduler", help="address of a Dask scheduler")
    parser.add_argument("--workers", type=int, default=2, help="processes on this machine, without --scheduler")
    parser.add_argument("--lyrefit", default="lyrefit", help="the command, as the workers find it")
    flags = parser.parse_args(own)

    cluster = flags.scheduler or LocalCluster(
        n_workers=flags.workers, threads_per_worker=1, processes=True, dashboard_address=None)
    with Client(cluster) as client:
        tasks = [client.submit(run_shard, os.getcwd(), flags.lyrefit, flags.inputs, flags.out, k, flags.shards,
                               options, retries=1, pure=False) for k in range(1, flags.shards + 1)]
        for count, task in enumerate(as_completed(tasks), start=1):
            print(f"shard {task.result()} done, {count} of {flags.shards}", flush=True)
    if not flags.scheduler:
        cluster.close()
    subprocess.run([flags.lyrefit, "merge", f"{flags.out}/shards", "--out", flags.out], check=True)


if __name__ == "__main__":
    main()
