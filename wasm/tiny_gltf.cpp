// TinyGLTF itself, which natively is a library of Debian's.
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
