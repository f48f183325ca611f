# SPDX-License-Identifier: MIT
#
# The promise: files include only what their layer may include. They use only operations that give the same bits everywhere. Each line is
# one rule: rule(folder, what the path must match, the rest of the arrow).
cmake_minimum_required(VERSION 3.22)
set(rule_count 0)

# Fills `files` with the C and C++ files of a folder, relative to SOURCE.
function(list_files folder)
  file(GLOB_RECURSE found RELATIVE ${SOURCE} ${SOURCE}/${folder}/*)
  list(FILTER found INCLUDE REGEX "[.](h|hpp|c|cpp)$")
  list(FILTER found EXCLUDE REGEX "node_modules/")
  set(files "${found}" PARENT_SCOPE)
endfunction()

# Reads a file, without its comments and without the characters that have a meaning in CMake's lists.
function(read_code file)
  file(READ ${SOURCE}/${file} text)
  string(REGEX REPLACE "[][;]" " " text "${text}")
  string(REGEX REPLACE "//[^\n]*" "" text "${text}")
  string(REGEX REPLACE "/[*]([^*]|[*]+[^*/])*[*]+/" "" text "${text}")
  set(code "\n${text}\n" PARENT_SCOPE)
endfunction()

# Files of `folder` whose path matches `path` may include only headers that match `allowed`, a regex for "name" or <name>.
function(may_include folder path allowed)
  list_files(${folder})
  set(seen 0)
  foreach(file IN LISTS files)
    if(file MATCHES "${path}")
      math(EXPR seen "${seen} + 1")
      read_code(${file})
      string(REGEX MATCHALL "\n[ \t]*#[ \t]*include[ \t]*[\"<][^\">\n]+[\">]" includes "${code}")
      foreach(include IN LISTS includes)
        string(REGEX MATCH "[\"<].*" header "${include}")
        if(NOT header MATCHES "^(${allowed})$")
          message(SEND_ERROR "${file} includes ${header}, which its layer must not know")
        endif()
      endforeach()
    endif()
  endforeach()
  if(seen EQUAL 0)
    message(SEND_ERROR "no file of ${folder} matches ${path}: the rule has nothing to hold")
  endif()
  math(EXPR count "${rule_count} + 1")
  set(rule_count ${count} PARENT_SCOPE)
endfunction()

# In `folder`, code may match `word` only in files whose path matches `except`.
function(must_not_say folder word except reason)
  list_files(${folder})
  foreach(file IN LISTS files)
    if(NOT file MATCHES "${except}")
      read_code(${file})
      if(code MATCHES "${word}")
        string(STRIP "${CMAKE_MATCH_0}" match)
        message(SEND_ERROR "${file} says '${match}': ${reason}")
      endif()
    endif()
  endforeach()
  math(EXPR count "${rule_count} + 1")
  set(rule_count ${count} PARENT_SCOPE)
endfunction()

# A .cpp beside a header of its name must include that header first. So the compiler sees that the header needs nothing else.
function(own_header_first folder)
  list_files(${folder})
  foreach(file IN LISTS files)
    string(REGEX REPLACE "[.]cpp$" ".h" header "${file}")
    if(file MATCHES "[.]cpp$" AND header IN_LIST files)
      read_code(${file})
      string(REGEX MATCH "#[ \t]*include[ \t]*([^\n]*)" first "${code}")
      if(NOT CMAKE_MATCH_1 STREQUAL "\"${header}\"")
        message(SEND_ERROR "${file} includes ${CMAKE_MATCH_1} before \"${header}\", its own header")
      endif()
    endif()
  endforeach()
  math(EXPR count "${rule_count} + 1")
  set(rule_count ${count} PARENT_SCOPE)
endfunction()

set(standard "<[a-z_]+>")  # <cmath>: no dot, no slash
set(nowhere "^$")
set(public "\"include/swivel/swivel(_bodies|_regions)?[.]h\"")  # the numbers of fields, features and flags, and definitions

# ---- the public headers: swivel.h and lecture.h need none of ours, others a neighbour or two
may_include(include "include/swivel/(swivel|lecture)[.]h$" "<(std(def|int)|string)[.]h>")
may_include(include "include/swivel/swivel_(bodies|regions)[.]h$" "\"swivel[.]h\"")
may_include(include "include/swivel/swivel_explain[.]h$" "\"swivel_bodies[.]h\"")
may_include(include "include/swivel/swivel[.]hpp$" "${standard}|\"swivel_bodies[.]h\"")
may_include(include "include/swivel/swivel_bodies[.]hpp$" "\"swivel[.]hpp\"")
may_include(include "include/swivel/swivel_regions[.]hpp$" "\"swivel[.]hpp\"|\"swivel_regions[.]h\"")
may_include(include "include/swivel/swivel_explain[.]hpp$" "\"swivel[.]hpp\"|\"swivel_explain[.]h\"")
may_include(include "" "${standard}|\"swivel(_bodies|_regions|_explain)?[.]h(pp)?\"|<(std(def|int)|string)[.]h>")

# ---- core: formulas and the standard library; the oracle shares nothing with the formulas. arm.h takes fields, features and the bits of flags from swivel.h,
# region.h the structure of a region from swivel_regions.h, group_rules.h the constants of plants and grounds from swivel_bodies.h
may_include(core "core/(isa|num|algebra|conformal|pack|arm|frame_rotor|solve_arm|space|pipeline)[.]h$"
            "<(bit|cmath|cstddef|cstdint|type_traits|utility)>|\"core/(isa|num|algebra|conformal|pack|arm|frame_rotor|solve_arm|space)[.]h\"|${public}")
may_include(core "core/dense[.]h$" "<cmath>")
may_include(core "core/reference[.]h$" "none")
may_include(core "core/reference[.]cpp$" "<cmath>|\"core/(dense|reference)[.]h\"")
may_include(core "" "${standard}|\"core/[a-z_]+[.]h\"|${public}")
must_not_say(core "#[ \t]*include[ \t]*\"include/[^\n]*" "core/(arm|group_rules|region)[.]h$"
             "formulas know no crowd; arm.h knows the bits of flags, region.h regions, group_rules.h constants of groups")

# ---- simd: lanes and rows are on the ground; stages of limbs, stages of bodies and the files of kernels stand above them in this order
may_include(simd "simd/lanes[.]h$" "${standard}|<xsimd/xsimd.hpp>|\"core/num[.]h\"")
may_include(simd "simd/(stages|strip_rows|body_rows)[.]h$" "${standard}|\"core/group_rules[.]h\"|\"simd/(fields|rows|stages)[.]h\"")
may_include(simd "simd/values[.]h$" "${standard}|\"simd/lanes[.]h\"")
may_include(simd "simd/component_rows[.]h$" "\"core/conformal[.]h\"|\"simd/(fields|lanes)[.]h\"")
may_include(simd "simd/slice[.]h$" "${standard}|\"core/(joint_limits|space)[.]h\"|\"simd/(component_rows|kernels|lanes|rows)[.]h\"")
may_include(simd "simd/pack[.]h$" "${standard}|\"core/pack[.]h\"|\"simd/(component_rows|kernels|lanes|rows)[.]h\"")
may_include(simd "simd/fields[.]h$" "${standard}|${public}")
may_include(simd "simd/(dispatch[.](h|cpp)|kernels[.]h|rows[.]h)$" "${standard}|\"simd/(body_rows|dispatch|fields|kernels|stages)[.]h\"|\"core/isa[.]h\"")
may_include(simd "simd/float_env[.]h$" "${standard}|<xmmintrin[.]h>")
may_include(simd "simd/transpose[.]h$" "${standard}|<(emmintrin|arm_neon)[.]h>|\"simd/fields[.]h\"")
may_include(simd/limbs "" "${standard}|\"core/[a-z_]+[.]h\"|\"simd/(slice|stages|strip_rows)[.]h\"|\"simd/limbs/[a-z_]+[.]h\"")
may_include(simd/bodies "" "${standard}|\"core/[a-z_]+[.]h\"|\"simd/(component_rows|kernels|lanes|values)[.]h\"|\"simd/(limbs|bodies)/[a-z_]+[.]h\"")
may_include(simd/kernels "(arm_kernels[.]cpp|aside[.]h)$" "${standard}|\"core/(isa|solve_arm)[.]h\"|\"simd/(kernels|pack|rows|slice|strip_rows)[.]h\"|\"simd/kernels/aside[.]h\"")
may_include(simd/kernels "limb_kernels[.]cpp$" "${standard}|\"core/allowed_arcs[.]h\"|\"simd/(limbs|bodies)/[a-z]+_stages[.]h\"")
may_include(simd/kernels "body_kernels[.]cpp$" "${standard}|\"core/(fit|(joint|matrix)_frame)[.]h\"|\"simd/bodies/body_[a-z]+[.]h\"")

# ---- batch: never lanes. A room sees the rooms that stand before it here. Explanations are a library of their own.
set(rooms "refusal")
foreach(room refusal region crowd solve api query explain)
  string(APPEND rooms "|${room}")
  if(room STREQUAL "explain")
    string(APPEND public "|\"include/swivel/swivel_explain[.]h\"")
  endif()
  may_include(batch/${room} "" "${standard}|${public}|\"batch/(${rooms})/[a-z_]+[.]h\"|\"simd/(body_rows|dispatch|fields|kernels|rows|strip_rows|float_env|transpose)[.]h\"|\"core/[a-z_]+[.]h\"|<oneapi/tbb/[a-z_]+[.]h>")
endforeach()
foreach(room refusal api)
  must_not_say(batch/${room} "#[ \t]*include[ \t]*\"core/[^\n]*" ${nowhere} "this room knows no formula")
endforeach()

# ---- lecture: formulas in double and the oracle; it needs no crowd
may_include(lecture "" "${standard}|\"include/swivel/lecture[.]h\"|\"core/[a-z_]+[.]h\"|\"simd/float_env[.]h\"")

# ---- tools and bench: the public headers and their own; a format knows no solver
foreach(folder tools bench)
  # To count a formula's operations, op_counts needs the formula itself. Of the corpus, arms.cpp alone sees the table of fields: it draws
  # values by their parts, which the public headers tell in words only.
  must_not_say(${folder} "#[ \t]*include[ \t]*\"(core|simd|batch|tests)/[^\n]*" "bench/rivals/(counted[.]h|op_counts[.]cpp)$|tools/corpus/arms[.]cpp$"
               "only the public headers are for it")
  must_not_say(${folder} "#[ \t]*include[ \t]*[\"<]swivel/[^\n]*[^.hp\">\n][\">]" ${nowhere} "the public headers end in .h and .hpp")
endforeach()
may_include(tools/corpus "" "${standard}|\"swivel/swivel(_bodies|_regions)?[.]h(pp)?\"|\"simd/fields[.]h\"|\"tools/corpus/[a-z_]+[.]h\"")
must_not_say(tools/corpus "[^a-zA-Z_](std::)?(a?(sin|cos|tan)h?|atan2|sincos|exp2?|log(2|10)?|pow|cbrt|hypot|fma)f?[ \t]*[(]" ${nowhere}
             "the corpus's numbers are the same everywhere: + - * / and sqrt")
must_not_say(tools/formats "#[ \t]*include[ \t]*[\"<](swivel/|tools/(rig|crowd|feet|retarget|cli|swivel))[^\n]*" ${nowhere} "a format knows no solver")
must_not_say(tools/rig "#[ \t]*include[ \t]*\"tools/(crowd|feet|retarget|cli|swivel|corpus)/[^\n]*" ${nowhere} "a rig knows skeletons and the library alone")
must_not_say(tools/crowd "#[ \t]*include[ \t]*\"tools/(feet|retarget|cli|swivel|corpus)/[^\n]*" ${nowhere} "a crowd knows no command")
must_not_say(tools/feet "#[ \t]*include[ \t]*\"tools/(cli|swivel|corpus)/[^\n]*" ${nowhere} "feet know no command")
must_not_say(tools/retarget "#[ \t]*include[ \t]*\"tools/(cli|swivel|corpus)/[^\n]*" ${nowhere} "retargeting knows no command")
must_not_say(tools/cache "#[ \t]*include[ \t]*(\"tools/(rig|cli|swivel|corpus)/|<Eigen/)[^\n]*" ${nowhere} "a cache knows no clip and no command")
must_not_say(tools/cache "#[ \t]*include[ \t]*\"tools/crowd/(clip|characters|crowd_|demo|given|limb_setups)[^\n]*" ${nowhere} "a cache knows goals alone")
must_not_say(tools/cli "#[ \t]*include[ \t]*\"tools/(rig|crowd|swivel|corpus)/[^\n]*" ${nowhere} "a command line knows no subcommand")
must_not_say(tools "[^a-zA-Z_]toml::" "tools/formats/(toml_table|crowd_file)[.](h|cpp)$" "TOML is read in tools/formats/toml_table alone")
must_not_say(tools/swivel "#[ \t]*include[ \t]*\"bench/[a-z_]+[.]h[^\n]*" ${nowhere} "the command does not know the suite")
must_not_say(tools/formats "#[ \t]*include[ \t]*\"bench/[^\n]*" ${nowhere} "a format knows no benchmark")
must_not_say(bench/rivals "#[ \t]*include[ \t]*(\"bench/[a-z_]+[.]h|<benchmark/)[^\n]*" ${nowhere} "the rivals do not know the suite")
must_not_say(tools "pybind11" "tools/python/" "the binding is in tools/python alone")
must_not_say(bench "#[ \t]*include[ \t]*\"tools/[^\n]*" ${nowhere} "the benchmarks do not know the tools")


# ---- examples see what an installed swivel has; replay also reads files
may_include(examples "examples/replay[.]cpp$" "${standard}|<swivel/swivel[.]hpp>|\"tools/formats/(bvh|clip)[.]h\"")
may_include(examples "examples/(game_loop|feet|hello|own_jobs|arms|groups)[.]c" "${standard}|<(stdio|math)[.]h>|<swivel/swivel(_bodies)?[.]h(pp)?>")

foreach(folder core simd batch bench tests tools)
  own_header_first(${folder})
endforeach()

foreach(folder core simd batch include)
  # ---- names that belong to one file
  must_not_say(${folder} "[^a-z_A-Z]xsimd[:/]" "simd/lanes[.]h$" "xsimd is named in simd/lanes.h alone")
  must_not_say(${folder} "[^a-zA-Z]tbb[:/]" "batch/solve/schedule[.]cpp$" "oneTBB is named in batch/solve/schedule.cpp alone")
  # ---- only + - * / sqrt, comparisons, selects and sign bits
  must_not_say(${folder} "[^a-zA-Z_](a?(sin|cos|tan)h?|atan2|sincos)f?[ \t]*[(]" "batch/((explain|region)/[a-z_]+|query/(joint_)?angles)[.]cpp$"
               "no trigonometry here")
  must_not_say(${folder} "[^a-zA-Z_](exp|exp2|log|log2|log10|pow|cbrt)f?[ \t]*[(]" ${nowhere} "not correctly rounded everywhere")
  must_not_say(${folder} "[^a-zA-Z]_*(builtin_)?(fma|fmaf|fms|fnma|rsqrt|reciprocal|mm[0-9]*_rcp[a-z0-9_]*|mm[0-9]*_rsqrt[a-z0-9_]*)[ \t]*[(]"
               ${nowhere} "its bits differ between CPUs")
endforeach()
foreach(folder core simd)
  must_not_say(${folder} "[^a-zA-Z_]f?(min|max)f?[ \t]*[(<]" ${nowhere} "use lo and hi: min and max differ between CPUs on NaN and zeros")
  must_not_say(${folder} "[^a-zA-Z_](hypot|remainder|fmod|rint|nearbyint|round|floor|ceil)f?[ \t]*[(]" ${nowhere} "not in num.h's list")
endforeach()
# simd may use intrinsics for what compilers' operators on vectors cannot say, for the control word, and to move words.
must_not_say(simd "[^a-zA-Z_](_mm[0-9]*_[a-z0-9_]+|v[a-z]+q_f32)" "simd/(lanes|float_env|transpose)[.]h$"
             "intrinsics belong to lanes.h, float_env.h and transpose.h")

# ---- flags that would change bits
file(READ ${SOURCE}/CMakeLists.txt build)
string(REGEX REPLACE "#[^\n]*" "" build "${build}")
foreach(flag -ffast-math -Ofast -march= -mtune= -mfma -funsafe-math -fassociative-math -freciprocal-math)
  string(FIND "${build}" "${flag}" at)
  if(NOT at EQUAL -1)
    message(SEND_ERROR "CMakeLists.txt says ${flag}: bits would depend on the machine")
  endif()
endforeach()
string(FIND "${build}" "-ffp-contract=off" at)
if(at EQUAL -1)
  message(SEND_ERROR "CMakeLists.txt does not say -ffp-contract=off: compilers would fuse products and sums")
endif()
message(STATUS "${rule_count} rules")
