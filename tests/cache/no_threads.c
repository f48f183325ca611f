/* SPDX-License-Identifier: MIT
 *
 * Preloaded, it ends a process that starts a thread, with exit code 99. */
#include <pthread.h>
#include <unistd.h>

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*), void* of)
{
    (void)thread, (void)attributes, (void)run, (void)of;
    _exit(99);
}
