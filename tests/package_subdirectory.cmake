# SPDX-License-Identifier: MIT
#
# The promise: a host may build swivel as a part of itself. The host's options do not change swivel's bits, and the host's programs get
# none of swivel's options. This builds for scalar alone and hardly optimises, because the build takes most of the time here.
#   WORK: an own folder. SOURCE: the repository. SHARED, TBB. See package/host.cmake, too.
cmake_minimum_required(VERSION 3.22)
include(${CMAKE_CURRENT_LIST_DIR}/package/host.cmake)
unset(ENV{SWIVEL_FORCE_ISA})

if(SHARED)
  set(how -DBUILD_SHARED_LIBS=ON -DSWIVEL_INSTALL=ON)
else()
  set(how -DFETCH=ON)
endif()
build_host(${CMAKE_CURRENT_LIST_DIR}/package/host ${WORK} -DSWIVEL=${SOURCE} -DSWIVEL_ISAS=scalar -DSWIVEL_TBB=${TBB}
           -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG" ${how})
must_print_the_line(${WORK}/arm_c)
must_print_the_line(${WORK}/arm_cpp)

# The host's programs are compiled and linked with these options. -DNDEBUG and -ffast-math are the host's own.
quote(${WORK} place)
quote(${SOURCE} source)
must_say_only("the host" "${commands}" "-[IDfm]|-isystem" "-I${source}/include|-ffast-math|-DNDEBUG")
must_say_only("the host" "${commands}" "-[lL]|-Wl,|[^ \n]*[.]so|[^ \n]*lib[a-z_]*[.]a"
              "[^ ]*/libswivel[.](so[.0-9]*|a)|[^ ]*/libswivel_explain[.]a|-Wl,-rpath,${place}[^ ]*|[^ ]*/libtbb[.]so[.0-9]*")
if(SHARED AND commands MATCHES "libtbb")
  message(SEND_ERROR "a host of the shared library links oneTBB")
endif()
message(STATUS "built as a part of a host")
