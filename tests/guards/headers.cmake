# Every header compiles alone: one .cpp per header, which includes it twice and nothing else. Built by ctest, so that a
# header that leans on its includer fails a test and not the build. Without optimisation, sanitizers and debug
# information: only the compiler's opinion counts. Headers of the libraries that the golden scenes need have no .cpp here
# where a source file of their own includes them first: the preset golden-O0 compiles each of those files alone.
file(GLOB_RECURSE HEADERS RELATIVE ${CMAKE_SOURCE_DIR} CONFIGURE_DEPENDS
  ${CMAKE_SOURCE_DIR}/model/*.h ${CMAKE_SOURCE_DIR}/formats/*.h
  ${CMAKE_SOURCE_DIR}/generator/*.h ${CMAKE_SOURCE_DIR}/process/*.h ${CMAKE_SOURCE_DIR}/checks/*.h ${CMAKE_SOURCE_DIR}/corpus/*.h
  ${CMAKE_SOURCE_DIR}/fuzz/*.h ${CMAKE_SOURCE_DIR}/import/*.h ${CMAKE_SOURCE_DIR}/renders/*.h
  ${CMAKE_SOURCE_DIR}/server/*.h ${CMAKE_SOURCE_DIR}/cli/*.h
  ${CMAKE_SOURCE_DIR}/tests/*.h ${CMAKE_SOURCE_DIR}/bench/*.h)
set(HEADER_SOURCES)
foreach(HEADER IN LISTS HEADERS)
  string(REGEX REPLACE "h$" "cpp" OWN_SOURCE ${CMAKE_SOURCE_DIR}/${HEADER})
  if(HEADER MATCHES "^(model|formats|generator|process|checks|corpus|fuzz)/" AND EXISTS ${OWN_SOURCE})
    file(STRINGS ${OWN_SOURCE} FIRST_INCLUDE REGEX "^#include" LIMIT_COUNT 1)
    if(FIRST_INCLUDE STREQUAL "#include \"${HEADER}\"")
      continue()
    endif()
  endif()
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
set_tests_properties(Guards.HeadersCompileAlone PROPERTIES TIMEOUT 1200 RUN_SERIAL ON LABELS slow)

# Benches compile: nobody runs them every day, and what they measure changes under them.
file(GLOB BENCHES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/bench/*.cpp)
find_path(MUJOCO_INCLUDE mujoco/mujoco.h)
if(NOT MUJOCO_INCLUDE)
  list(FILTER BENCHES EXCLUDE REGEX dynamics_bench)
endif()
find_path(FCL_INCLUDE fcl/narrowphase/distance.h)
find_path(BULLET_INCLUDE btBulletCollisionCommon.h PATH_SUFFIXES bullet)
add_library(contort_bench_objects OBJECT EXCLUDE_FROM_ALL ${BENCHES})
target_include_directories(contort_bench_objects PRIVATE ${CMAKE_SOURCE_DIR} ${CMAKE_SOURCE_DIR}/adapters/cpp)
target_compile_options(contort_bench_objects PRIVATE -Wall -Wextra -Wshadow -Wconversion -Werror -Wno-unused-function -O0 -g0)
target_compile_definitions(contort_bench_objects PRIVATE
  CONTORT_ASSERTS CONTORT_HAS_MUJOCO CONTORT_SOURCE_DIR="${CMAKE_SOURCE_DIR}" CONTORT_BINARY_DIR="${CMAKE_BINARY_DIR}")

if(FCL_INCLUDE)
  find_package(fcl CONFIG QUIET)
  target_link_libraries(contort_bench_objects PRIVATE fcl)
  target_compile_definitions(contort_bench_objects PRIVATE CONTORT_HAS_FCL)
endif()
if(BULLET_INCLUDE)
  target_include_directories(contort_bench_objects SYSTEM PRIVATE ${BULLET_INCLUDE})
  target_compile_definitions(contort_bench_objects PRIVATE CONTORT_HAS_BULLET)
endif()

add_test(NAME Guards.BenchesCompile
  COMMAND ${CMAKE_COMMAND} --build ${CMAKE_BINARY_DIR} --target contort_bench_objects)
set_tests_properties(Guards.BenchesCompile PROPERTIES TIMEOUT 1200 RUN_SERIAL ON LABELS slow)
