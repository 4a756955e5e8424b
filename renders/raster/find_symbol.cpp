#include "renders/raster/find_symbol.h"

#include <dlfcn.h>

namespace contort {

void* symbol_of(void* library, const char* name) { return ::dlsym(library, name); }

}  // namespace contort
