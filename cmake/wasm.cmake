# The built-in generator and the checks as WebAssembly (docs/internals/wasm.md). Left out is what needs compiled libraries
# of Debian: Lua, so actions with scripts are refused (wasm/without_scripts.cpp), and the readers of recordings.
include(${CMAKE_SOURCE_DIR}/cmake/compiled_in.cmake)
list(FILTER GENERATOR_SOURCES EXCLUDE REGEX "/generator/(recordings|actions/script|actions/script_functions)\\.cpp$")
contort_library(contort_generator SOURCES ${GENERATOR_SOURCES} wasm/without_scripts.cpp USES contort_model)
contort_library(contort_evaluator SOURCES corpus/evaluator.cpp USES contort_checks)

# The golden hashes under Node: contort_golden.js SPECS
add_executable(contort_golden tests/golden/wasm_main.cpp tests/golden/hashes.cpp tests/scenes.cpp)
target_link_libraries(contort_golden PRIVATE contort_generator contort_evaluator)
target_link_options(contort_golden PRIVATE -sENVIRONMENT=node -sNODERAWFS=1 -sSINGLE_FILE=1 -sEXIT_RUNTIME=1
  -sALLOW_MEMORY_GROWTH=1)

# What a page plays specs with: one classic script, because a page that is opened from a disk can load nothing else.
set(ENGINE_RENDERS case_data check_words ground highlight measured_text needs page_call scene wording)
list(TRANSFORM ENGINE_RENDERS REPLACE "(.+)" "renders/\\1.cpp")
file(GLOB ENGINE_GLTF CONFIGURE_DEPENDS formats/gltf/write*.cpp)
add_executable(contort_engine wasm/engine.cpp wasm/stored_gzip.cpp wasm/tiny_gltf.cpp ${ENGINE_RENDERS} ${ENGINE_GLTF})
set_source_files_properties(wasm/tiny_gltf.cpp PROPERTIES COMPILE_OPTIONS -w SKIP_UNITY_BUILD_INCLUSION ON)
target_link_libraries(contort_engine PRIVATE contort_generator contort_evaluator TinyGLTF::TinyGLTF)
target_compile_definitions(contort_engine PRIVATE TINYGLTF_NO_STB_IMAGE TINYGLTF_NO_STB_IMAGE_WRITE)
target_link_options(contort_engine PRIVATE -sENVIRONMENT=web,node -sALLOW_MEMORY_GROWTH=1 -sMODULARIZE=1
  -sEXPORT_NAME=contortEngine -sEXPORTED_FUNCTIONS=_contort_add,_contort_play,_malloc,_free
  -sEXPORTED_RUNTIME_METHODS=allocateUTF8,UTF8ToString)
add_custom_command(OUTPUT ${CMAKE_BINARY_DIR}/engine.js VERBATIM DEPENDS contort_engine wasm/pack.mjs
  COMMAND node ${CMAKE_SOURCE_DIR}/wasm/pack.mjs $<TARGET_FILE:contort_engine> ${CMAKE_BINARY_DIR}/contort_engine.wasm
          ${CMAKE_BINARY_DIR}/engine.js ${CONTORT_IN_ENGINE})
add_custom_target(engine ALL DEPENDS ${CMAKE_BINARY_DIR}/engine.js)
