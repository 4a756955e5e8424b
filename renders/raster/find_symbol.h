// Finds functions of libraries that are loaded at run time.
#pragma once

namespace contort {

// Returns the address of a name in a library that dlopen has loaded; nullptr if it has none.
void* symbol_of(void* library, const char* name);

// Sets `into` to the function of that name; returns false if the library has none.
template <class Function>
bool find_symbol(void* library, const char* name, Function*& into) {
  into = reinterpret_cast<Function*>(symbol_of(library, name));
  return into != nullptr;
}

}  // namespace contort
