# Every header compiles alone: one .cpp per header, which includes it twice and nothing else. Built by ctest, so that a
# header that leans on its includer fails a test and not the build. Without optimisation, sanitizers and debug
# information: only the compiler's opinion counts.
file(GLOB_RECURSE HEADERS RELATIVE ${CMAKE_SOURCE_DIR} CONFIGURE_DEPENDS
  ${CMAKE_SOURCE_DIR}/generator/*.h ${CMAKE_SOURCE_DIR}/checks/*.h ${CMAKE_SOURCE_DIR}/corpus/*.h
  ${CMAKE_SOURCE_DIR}/fuzz/*.h ${CMAKE_SOURCE_DIR}/renders/*.h ${CMAKE_SOURCE_DIR}/cli/*.h
  ${CMAKE_SOURCE_DIR}/tests/*.h ${CMAKE_SOURCE_DIR}/bench/*.h)
set(HEADER_SOURCES)
foreach(HEADER IN LISTS HEADERS)
  set(SOURCE ${CMAKE_CURRENT_BINARY_DIR}/headers/${HEADER}.cpp)
  file(CONFIGURE OUTPUT ${SOURCE} CONTENT "#include \"@HEADER@\"\n#include \"@HEADER@\"\n" @ONLY)
  list(APPEND HEADER_SOURCES ${SOURCE})
endforeach()

add_library(contort_headers OBJECT EXCLUDE_FROM_ALL ${HEADER_SOURCES})
target_include_directories(contort_headers PRIVATE ${CMAKE_SOURCE_DIR})
target_compile_options(contort_headers PRIVATE -Wall -Wextra -Wshadow -Wconversion -Werror -O0 -g0)
target_compile_definitions(contort_headers PRIVATE
  CONTORT_ASSERTS CONTORT_SOURCE_DIR="${CMAKE_SOURCE_DIR}" CONTORT_BINARY_DIR="${CMAKE_BINARY_DIR}")

add_test(NAME Guards.HeadersCompileAlone
  COMMAND ${CMAKE_COMMAND} --build ${CMAKE_BINARY_DIR} --target contort_headers)
set_tests_properties(Guards.HeadersCompileAlone PROPERTIES TIMEOUT 600 RUN_SERIAL ON)
