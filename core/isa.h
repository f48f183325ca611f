// SPDX-License-Identifier: MIT
//
// Names the namespace of all formulas, so that one source, compiled for two instruction sets, gives functions of
// different names. Also has the attributes that keep calls out of kernel loops: formulas are many small functions, and
// compilers do not inline all of them on their own.
//
// SWIVEL_ALWAYS_INLINE is for the bottom alone: numbers, lanes, multivectors and their shapes in conformal.h, numbers
// on the swivel's circle, rows, and copies of their types. Each is one operation or a few. None has a closure: that is
// one more type and one more function to inline at every use. Multivectors are used in thousands of places, so with
// closures they compile far more slowly. SWIVEL_INLINE is for formulas and stages. A kernel's entry is SWIVEL_FLATTEN,
// which inlines all that it calls. So g++ optimises a formula once, as an ordinary function, before flatten collects
// it. It would optimise an always inlined formula again at every level of calls. And it would leave an ordinary
// operation as a call, with its operands in memory, until flatten runs. Both mistakes together made g++ 12 take 57 s of
// CPU for limb_kernels.cpp with AVX2, in place of 11 s.
#pragma once

#ifndef SWIVEL_ISA
#define SWIVEL_ISA base
#endif

#define SWIVEL_ALWAYS_INLINE [[gnu::always_inline]] inline
#ifdef __clang__  // its flatten inlines what an entry calls itself, and not what that calls
#define SWIVEL_INLINE SWIVEL_ALWAYS_INLINE
#define SWIVEL_INLINE_LAMBDA __attribute__((always_inline))
#else
#define SWIVEL_INLINE inline
#define SWIVEL_INLINE_LAMBDA
#endif
#define SWIVEL_FLATTEN [[gnu::flatten]]
#define SWIVEL_OUT_OF_LINE_LAMBDA __attribute__((noinline))  // long, called from many places, and seldom
#define SWIVEL_KEEP_LOOP _Pragma("GCC unroll 1")             // before a loop that the compiler must not unroll
