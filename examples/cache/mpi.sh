#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# usage: mpi.sh CACHE [RANKS]
# Fills a cache by ranks of MPI. Each has one thread. --shard auto reads the variables that mpirun sets; swivel needs no MPI library.
exec mpirun -n "${2:-4}" --oversubscribe swivel fill "$1" --shard auto --resume --threads 1
