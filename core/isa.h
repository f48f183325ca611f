// SPDX-License-Identifier: MIT
//
// Names the namespace of all formulas. So the same source, compiled for two instruction sets, gives functions of
// different names. This file also has the attributes that keep calls out of kernel loops. Formulas are many small
// functions, and compilers do not inline all of them on their own.
#pragma once

#ifndef SWIVEL_ISA
#define SWIVEL_ISA base
#endif

#define SWIVEL_INLINE [[gnu::always_inline]] inline
#define SWIVEL_INLINE_LAMBDA __attribute__((always_inline))
#define SWIVEL_FLATTEN [[gnu::flatten]]
// Before a loop that the compiler must not unroll.
#ifdef __clang__
#define SWIVEL_KEEP_LOOP _Pragma("clang loop unroll(disable)")
#else
#define SWIVEL_KEEP_LOOP _Pragma("GCC unroll 1")
#endif
