# The libraries of which headers are enough, for WebAssembly. They are linked into a folder of their own: /usr/include
# as a whole also has the headers of the machine's C library.
function(contort_header_library target)
  add_library(${target} INTERFACE IMPORTED)
  foreach(header IN LISTS ARGN)
    find_path(HEADER_FOLDER ${header} PATHS /usr/include NO_CACHE NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH REQUIRED)
    file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/include)
    cmake_path(APPEND HEADER_FOLDER ${header} OUTPUT_VARIABLE header_path)
    cmake_path(NORMAL_PATH header_path)
    file(CREATE_LINK ${header_path} ${CMAKE_BINARY_DIR}/include/${header} SYMBOLIC)
    unset(HEADER_FOLDER)
  endforeach()
  set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${CMAKE_BINARY_DIR}/include)
endfunction()
contort_header_library(glm::glm glm xxhash.h)
contort_header_library(nlohmann_json::nlohmann_json nlohmann)
contort_header_library(TinyGLTF::TinyGLTF tiny_gltf.h)
# What the standard library of Debian's Emscripten lacks.
target_include_directories(contort_flags SYSTEM INTERFACE ${CMAKE_SOURCE_DIR}/wasm/lacking)
# Emscripten's own scripts need Debian's acorn, which a Node.js from elsewhere does not look for there.
set_property(GLOBAL PROPERTY RULE_LAUNCH_LINK "${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs")
