// SPDX-License-Identifier: MIT
//
// Names the namespace of all formulas. So the same source, compiled for two instruction sets, gives functions of
// different names. This file also has the attributes that keep calls out of kernel loops. Formulas are many small
// functions, and compilers do not inline all of them on their own.
//
// Two kinds of functions. SWIVEL_ALWAYS_INLINE is for the bottom alone: numbers, lanes, multivectors, rows, and the
// copies of their types, each an operation or a few. SWIVEL_INLINE is for the formulas and stages above. The kernels'
// entries are SWIVEL_FLATTEN, which inlines all that they call. So a formula is optimised once before that, as an
// ordinary function. Were it always inlined, g++ would optimise each of its calls again on every level of calls, and
// would inline no ordinary function into it on the way. That made kernels four times as slow to compile. An operation
// that were ordinary would stay a call, with its operands in memory, until the whole stage is one function.
#pragma once

#ifndef SWIVEL_ISA
#define SWIVEL_ISA base
#endif

#define SWIVEL_ALWAYS_INLINE [[gnu::always_inline]] inline
#define SWIVEL_ALWAYS_INLINE_LAMBDA __attribute__((always_inline))
#ifdef __clang__  // its flatten inlines what an entry calls itself, and not what that calls
#define SWIVEL_INLINE SWIVEL_ALWAYS_INLINE
#define SWIVEL_INLINE_LAMBDA SWIVEL_ALWAYS_INLINE_LAMBDA
#else
#define SWIVEL_INLINE inline
#define SWIVEL_INLINE_LAMBDA
#endif
#define SWIVEL_FLATTEN [[gnu::flatten]]
#define SWIVEL_OUT_OF_LINE_LAMBDA __attribute__((noinline))  // long, called from many places, and seldom
// Before a loop that the compiler must not unroll.
#ifdef __clang__
#define SWIVEL_KEEP_LOOP _Pragma("clang loop unroll(disable)")
#else
#define SWIVEL_KEEP_LOOP _Pragma("GCC unroll 1")
#endif
