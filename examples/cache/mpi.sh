#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# usage: mpi.sh CACHE [RANKS]
# Fills a cache by ranks of MPI. Each has one thread. Open MPI and others set different variables; swivel needs no MPI library.
# Open MPI runs as root only with OMPI_ALLOW_RUN_AS_ROOT=1 and OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1.
fill='swivel fill "$0" --shard "$((${OMPI_COMM_WORLD_RANK-$PMI_RANK} + 1))/${OMPI_COMM_WORLD_SIZE-$PMI_SIZE}" --threads 1'
exec mpirun -n "${2:-4}" --oversubscribe bash -c "$fill" "${1:?usage: mpi.sh CACHE [RANKS]}"
