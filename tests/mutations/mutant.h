// SPDX-License-Identifier: MIT
//
// Faults that a program chooses as it runs; operators.py writes them into a copy of the tree. SWIVEL_MUTANT is the
// number of the one that is alive, and without it none is. With SWIVEL_MUTANTS_MET a program writes the numbers of
// those that it came across to a file of that name and of its process's number. Constant expressions come across none.
#pragma once

#include <unistd.h>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <type_traits>

namespace swivel_mutants {

struct Choice {
    static constexpr int kMax = 4096;
    int alive = -1;
    const char* met = std::getenv("SWIVEL_MUTANTS_MET");
    bool is_met[kMax] = {};

    Choice()
    {
        if (const char* const number = std::getenv("SWIVEL_MUTANT")) alive = std::atoi(number);
    }
    ~Choice()
    {
        if (!met) return;
        std::FILE* const file = std::fopen((met + ("." + std::to_string(getpid()))).c_str(), "a");
        for (int n = 0; file && n < kMax; ++n)
            if (is_met[n]) std::fprintf(file, "%d\n", n);
        if (file) std::fclose(file);
    }
    bool meets(int number)
    {
        if (met) is_met[number] = true;
        return alive == number;
    }
};
inline Choice choice;
constexpr bool is_alive(int number) { return !std::is_constant_evaluated() && choice.meets(number); }

// Stands between two operands, with the operator on either side: a + Other{7} + b is a + b, or a - b if mutant 7 is
// alive.
struct Other {
    int number;
};
template <class A>
struct Left {
    const A& a;
    int number;
};
#define SWIVEL_MUTANTS(op, other)                                  \
    template <class A>                                             \
    constexpr Left<A> operator op(const A& a, Other fault)         \
    {                                                              \
        return {a, fault.number};                                  \
    }                                                              \
    template <class A, class B>                                    \
    constexpr auto operator op(Left<A> left, const B& b)           \
    {                                                              \
        using Result = std::remove_cvref_t<decltype(left.a op b)>; \
        if (is_alive(left.number)) return Result(left.a other b);  \
        return Result(left.a op b);                                \
    }
SWIVEL_MUTANTS(+, -)
SWIVEL_MUTANTS(-, +)
SWIVEL_MUTANTS(<, <=)
SWIVEL_MUTANTS(<=, <)
SWIVEL_MUTANTS(>, >=)
SWIVEL_MUTANTS(>=, >)
SWIVEL_MUTANTS(==, !=)
SWIVEL_MUTANTS(!=, ==)
SWIVEL_MUTANTS(&, |)
SWIVEL_MUTANTS(|, &)
#undef SWIVEL_MUTANTS

// Stands before a condition: Never{7} && mask is the mask, or false in every lane if mutant 7 is alive.
struct Never {
    int number;
};
template <class Mask>
constexpr Mask operator&&(Never fault, const Mask& mask)
{
    if (is_alive(fault.number)) return Mask(mask & !mask);
    return mask;
}

}  // namespace swivel_mutants
