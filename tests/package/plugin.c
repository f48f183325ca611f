/* SPDX-License-Identifier: MIT
 *
 * A host that loads the shared library, solves on several threads, and closes it. The library's threads must not take
 * the host down. argument: the library. */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <swivel/swivel.h>
#include <time.h>

enum { ARM_COUNT = 100000 }; /* many chunks for threads */

static void* find(void* library, const char* name)
{
    void* const function = dlsym(library, name);
    if (function) return function;
    fprintf(stderr, "%s\n", dlerror());
    exit(1);
}

static int solve(void* library)
{
    swivel_status (*create)(const swivel_crowd_def*, swivel_crowd**);
    swivel_status (*solve_job)(swivel_crowd*, const swivel_job*);
    void (*destroy)(swivel_crowd*);
    const swivel_limb_def arms = swivel_default_limb_def(ARM_COUNT);
    swivel_group_def group = swivel_default_group_def();
    swivel_crowd_def def = swivel_default_crowd_def();
    swivel_crowd* crowd = NULL;
    int n, status = 1;

    *(void**)&create = find(library, "swivel_crowd_create");
    *(void**)&solve_job = find(library, "swivel_solve");
    *(void**)&destroy = find(library, "swivel_crowd_destroy");
    group.limb = &arms;
    def.group_count = 1;
    def.groups = &group;
    if (create(&def, &crowd) != SWIVEL_OK) return 1;
    for (n = 0, status = 0; n < 20; ++n) status |= solve_job(crowd, NULL) != SWIVEL_OK;
    destroy(crowd);
    return status;
}

int main(int argument_count, char** arguments)
{
    const struct timespec moment = {0, 200000000}; /* 0.2 s: threads that were busy fall asleep, and wake */
    int n;
    for (n = 0; n < 3; ++n) {
        void* const library = argument_count == 2 ? dlopen(arguments[1], RTLD_NOW | RTLD_LOCAL) : NULL;
        if (!library || solve(library) != 0) return fprintf(stderr, "no solve\n"), 1;
        dlclose(library);
        nanosleep(&moment, NULL);
        free(malloc(1 << 20));
    }
    puts("closed");
    return 0;
}
