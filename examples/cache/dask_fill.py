#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fills a cache by Dask.

usage: dask_fill.py CACHE [PARTS [SCHEDULER]]    PARTS: into which the cache is cut, 64 unless given; workers take one at a time.
                                                 SCHEDULER: such as tcp://node1:8786. Without it two workers start here.

All workers see the folder of the cache, and have the Python package of swivel."""
import sys

from distributed import Client

import swivel


def fill_part(index, folder, parts):
    return swivel.fill_cache(folder, index, parts, threads=1)


def main(folder, parts=64, scheduler=None):
    workers = {} if scheduler else {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": None}
    with Client(scheduler, **workers) as client:
        filled = client.gather(client.map(fill_part, range(int(parts)), folder=folder, parts=int(parts), pure=False))
        print(f"{len(client.scheduler_info()['workers'])} workers wrote {sum(each['written'] for each in filled)} chunks")


if __name__ == "__main__":
    if not 2 <= len(sys.argv) <= 4:
        sys.exit("usage: dask_fill.py CACHE [PARTS [SCHEDULER]]")
    main(*sys.argv[1:])
