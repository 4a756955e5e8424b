# find_package(contort): what an installation of Contort offers to other projects.
#
#   contort::contort   the program
#   contort::guest     #include <contort/contort_guest.h>, for a generator in C++17 that Contort tests
#   contort_rules_header(TARGET CORPUS FOLDER [NAME known_rules.h])
#                      writes what the corpus knows as a header that TARGET (C++20) can include: the rules of
#                      `contort explain`, written again whenever those of the corpus have changed
get_filename_component(contort_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

if(NOT TARGET contort::contort)
  add_executable(contort::contort IMPORTED)
  set_target_properties(contort::contort PROPERTIES IMPORTED_LOCATION "${contort_prefix}/bin/contort")
  add_library(contort::guest INTERFACE IMPORTED)
  target_include_directories(contort::guest INTERFACE "${contort_prefix}/include")
  target_compile_features(contort::guest INTERFACE cxx_std_17)
endif()

function(contort_rules_header target)
  cmake_parse_arguments(ARG "" "CORPUS;NAME" "" ${ARGN})
  if(NOT ARG_CORPUS OR ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "contort_rules_header(TARGET CORPUS FOLDER [NAME known_rules.h])")
  endif()
  if(NOT ARG_NAME)
    set(ARG_NAME known_rules.h)
  endif()
  get_filename_component(corpus "${ARG_CORPUS}" ABSOLUTE)
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/contort_rules/${target}")
  file(MAKE_DIRECTORY "${folder}")
  file(GLOB rules "${corpus}/rules.json")
  add_custom_command(
    OUTPUT "${folder}/${ARG_NAME}"
    COMMAND contort::contort explain "${corpus}" --stored --header "${folder}/${ARG_NAME}"
    DEPENDS contort::contort ${rules}
    COMMENT "Writing the rules of ${ARG_CORPUS}"
    VERBATIM)
  target_sources(${target} PRIVATE "${folder}/${ARG_NAME}")
  target_include_directories(${target} PRIVATE "${folder}")
  target_compile_features(${target} PRIVATE cxx_std_20)
endfunction()

unset(contort_prefix)
