/* SPDX-License-Identifier: MIT
 *
 * A program that has something to guard: a text on its stack, and calls that print into it and from it. In C, because
 * clang checks no such calls in C++. */
#include <stdio.h>

int main(int argc, char** argv)
{
    char text[64];
    snprintf(text, sizeof text, "%d: %s", argc, argv[0]);
    return fprintf(stderr, "%s, %d\n", text, argc) < 0;
}
