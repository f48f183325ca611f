// SPDX-License-Identifier: MIT
//
// Names the namespace that every formula lives in, so that the same source compiled for two instruction sets gives
// differently named functions, and the attributes that keep calls out of kernel loops: formulas are many small
// functions, and compilers give up inlining them all on their own.
#pragma once

#ifndef SWIVEL_ISA
#define SWIVEL_ISA base
#endif

#define SWIVEL_INLINE [[gnu::always_inline]] inline
#define SWIVEL_INLINE_LAMBDA __attribute__((always_inline))
#define SWIVEL_FLATTEN [[gnu::flatten]]
