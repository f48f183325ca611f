#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# usage: mpi.sh CACHE [RANKS]
# Fills a cache by ranks of MPI. Each has one thread. --shard auto reads the variables that mpirun sets; swivel needs no MPI library.
# Open MPI runs as root only with OMPI_ALLOW_RUN_AS_ROOT=1 and OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1.
exec mpirun -n "${2:-4}" --oversubscribe swivel fill "${1:?usage: mpi.sh CACHE [RANKS]}" --shard auto --resume --threads 1
