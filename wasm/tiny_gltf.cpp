// TinyGLTF itself, which is a library of the system in native builds.
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
