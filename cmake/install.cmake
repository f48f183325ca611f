# SPDX-License-Identifier: MIT
# `cmake --install` puts these under the prefix: the headers, the libraries, the command with its benchmarks and page,
# package files and the licence. You may move the whole prefix, because no file names its place.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(headers include/swivel/lecture.h)
foreach(header swivel swivel_bodies swivel_regions swivel_explain)
  list(APPEND headers include/swivel/${header}.h include/swivel/${header}.hpp)
endforeach()
install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/swivel)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
foreach(library swivel swivel_explain swivel_lecture)
  target_include_directories(${library} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  install(TARGETS ${library} EXPORT swivelTargets)
endforeach()
if(SWIVEL_TOOLS)
  set(programs swivel_command)
  if(SWIVEL_BENCH)
    list(APPEND programs swivel_bench)
  endif()
  if(BUILD_SHARED_LIBS)  # the command finds the library beside itself
    file(RELATIVE_PATH bin_to_lib ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
    set_target_properties(${programs} PROPERTIES INSTALL_RPATH "\$ORIGIN/${bin_to_lib}")
  endif()
  install(TARGETS ${programs})
  install(DIRECTORY ${PROJECT_BINARY_DIR}/share/swivel DESTINATION ${CMAKE_INSTALL_DATADIR})
  # The program of the pages that it writes, where tools/view/build has made it.
  install(FILES ${PROJECT_SOURCE_DIR}/build/view/view.html DESTINATION ${CMAKE_INSTALL_DATADIR}/swivel OPTIONAL)
endif()

# ---- find_package(swivel)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/swivel)
# A program that links the static library also needs oneTBB. If a C compiler links it, it needs the libraries of C++, too.
set(cxx_libraries "")
set(find_dependencies "")
set(link_as_c "# The shared library loads what it needs.")
if(NOT BUILD_SHARED_LIBS)
  set(cxx_libraries ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
  list(REMOVE_ITEM cxx_libraries ${CMAKE_C_IMPLICIT_LINK_LIBRARIES})
  list(REMOVE_DUPLICATES cxx_libraries)
  set(link_as_c "set_property(TARGET swivel::swivel APPEND PROPERTY INTERFACE_LINK_LIBRARIES \"${cxx_libraries}\")")
  if(SWIVEL_TBB)
    set(find_dependencies "include(CMakeFindDependencyMacro)\nfind_dependency(TBB)\n")
  endif()
endif()
configure_package_config_file(cmake/swivelConfig.cmake.in swivelConfig.cmake INSTALL_DESTINATION ${package_dir}
                              NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may change anything. From 1.0 on, this is SameMajorVersion.
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/swivelConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/swivelConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/swivelConfigVersion.cmake
        DESTINATION ${package_dir})
install(EXPORT swivelTargets NAMESPACE swivel:: DESTINATION ${package_dir})

# ---- pkg-config swivel, and swivel-explain for programs that explain
# pkg-config sets ${pcfiledir} to the folder in which it finds the file, so the prefix may move.
file(RELATIVE_PATH prefix_from_pc ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
file(RELATIVE_PATH pc_libdir ${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_LIBDIR})
file(RELATIVE_PATH pc_includedir ${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_INCLUDEDIR})
# A prefix has the shared library, which loads what it needs, or the static one. So no program asks for --static.
set(pc_libs swivel)
if(find_dependencies)
  list(APPEND pc_libs tbb)
endif()
list(APPEND pc_libs ${cxx_libraries})
string(REGEX REPLACE "/$" "" prefix_from_pc "${prefix_from_pc}")
list(TRANSFORM pc_libs PREPEND -l)
list(JOIN pc_libs " " pc_libs)
string(PREPEND pc_libs "-L\${libdir} ")
set(pc_explain "")
if(NOT BUILD_SHARED_LIBS)
  set(pc_explain "-L\${libdir} -lswivel_explain")
endif()
foreach(file swivel.pc swivel-explain.pc)
  configure_file(cmake/${file}.in ${file} @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${file} DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()
