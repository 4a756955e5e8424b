# `cmake --install`: programs, pages, adapters, headers and documents. All ways between installed files are relative, so
# that the folder may be moved as a whole (cli/program_files.h).
install(TARGETS contort RUNTIME DESTINATION bin)
install(TARGETS contort-render RUNTIME DESTINATION libexec/contort)
if(NPM)
  install(DIRECTORY ${CMAKE_BINARY_DIR}/page DESTINATION share/contort OPTIONAL)
endif()
install(DIRECTORY adapters DESTINATION share/contort PATTERN __pycache__ EXCLUDE)

# The document folder has the layout of docs, so that links between pages lead somewhere.
install(DIRECTORY docs/ DESTINATION share/doc/contort PATTERN __pycache__ EXCLUDE)
install(FILES CHANGELOG.md DESTINATION share/doc/contort)

# The library for generators in C++: find_package(contort) or pkg-config.
install(FILES adapters/cpp/contort_guest.h DESTINATION include/contort)
include(CMakePackageConfigHelpers)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/contort-config-version.cmake COMPATIBILITY SameMinorVersion
  ARCH_INDEPENDENT)
install(FILES cmake/contort-config.cmake ${CMAKE_BINARY_DIR}/contort-config-version.cmake
  DESTINATION share/cmake/contort)
configure_file(cmake/contort.pc.in ${CMAKE_BINARY_DIR}/contort.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/contort.pc DESTINATION share/pkgconfig)

# What the program says of itself, and what it is made of, is written when it is installed.
configure_file(cmake/install_texts.cmake.in ${CMAKE_BINARY_DIR}/install_texts.cmake @ONLY)
install(SCRIPT ${CMAKE_BINARY_DIR}/install_texts.cmake)
