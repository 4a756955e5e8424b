# Debian packages of which code is in our programs, as headers or as a static library. Their licences go along with each
# copy. All other libraries are shared ones, which stay packages of their own.
set(CONTORT_COMPILED_IN libcli11-dev libglm-dev librapidcheck-dev libxxhash-dev nlohmann-json3-dev)
# The same of engine.js, which is WebAssembly; Emscripten has the C and C++ libraries of it.
set(CONTORT_IN_ENGINE emscripten libglm-dev libtinygltf-dev libxxhash-dev nlohmann-json3-dev)
# And packages of npm that are in the scripts of the pages.
set(CONTORT_BUNDLED three uplot)
